// SPDX-License-Identifier: GPL-3.0-or-later
// Integrators on a small smooth problem with a known answer: orders, grids, stops, guards.
#include <spam/core/error.hpp>
#include <spam/diagnostics/fits.hpp>
#include <spam/integrate/driver.hpp>
#include <spam/integrate/methods.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace spam;

namespace {

/// Nonlinear and not autonomous: y0' = y1, y1' = -y0 + (cos t - y0)^2 with y0 = cos t.
Ode cosine() {
    Ode ode;
    ode.rates = [](double t, std::span<const double> y, std::span<double> y_dot) {
        y_dot[0] = y[1];
        y_dot[1] =
            -y[0] + std::pow(std::cos(t) - y[0], 2) + 0.3 * std::sin(t) * (std::cos(t) - y[0]);
    };
    ode.failure = [] { return std::string{}; };
    ode.entry_name = [](std::size_t k) { return std::to_string(k); };
    ode.absolute_tolerance = {1e-12, 1e-12};
    return ode;
}

/// Its rates are not numbers after t = 0.45.
Ode spoilt_cosine() {
    Ode ode = cosine();
    ode.rates = [good = ode.rates](double t, std::span<const double> y, std::span<double> y_dot) {
        good(t, y, y_dot);
        if (t > 0.45) y_dot[1] = std::numeric_limits<double>::quiet_NaN();
    };
    return ode;
}

/// y0 = exp(sin t), y1 = 1/(1 + t): another one, with error terms of every kind.
Ode growth() {
    Ode ode = cosine();
    ode.rates = [](double t, std::span<const double> y, std::span<double> y_dot) {
        y_dot[0] = y[0] * std::cos(t);
        y_dot[1] = -y[1] * y[1];
    };
    return ode;
}

/// On its way from y = (1, y1).
struct Solution {
    const SundialsContext context;
    const Ode ode;
    Vector y{2, context};
    std::unique_ptr<Integrator> integrator;

    explicit Solution(const IntegratorOptions& options, Ode of = cosine(), double y1 = 0.0)
        : ode(std::move(of)) {
        y.span()[0] = 1.0;
        y.span()[1] = y1;
        integrator = make_integrator(options, ode, y, 0.0, context);
    }
};

struct Run {
    double error;
    Integrator::Statistics statistics;
};

Run run(const IntegratorOptions& options, double t_end) {
    Solution of(options);
    double error = 0.0;  // the largest on the way: at one time alone it may cross zero
    Observers observers;
    observers.output = [&](double t) {
        const auto y = of.y.span();
        error = std::max(error, std::hypot(y[0] - std::cos(t), y[1] + std::sin(t)));
    };
    drive(*of.integrator, {t_end, 0.8, t_end}, observers);
    return {error, of.integrator->statistics()};
}

IntegratorOptions fixed(const std::string& method, double dt) {
    return {.method = method, .dt = dt};
}

IntegratorOptions adaptive(const std::string& method, double rtol = 1e-8, double atol = 1e-10) {
    IntegratorOptions options;
    options.method = method;
    options.rtol = rtol;
    options.atol = atol;
    return options;
}

double order_of(const std::string& method, double largest_step) {
    std::vector<double> steps, errors;
    for (int k = 0; k < 4; ++k) {
        steps.push_back(largest_step * std::pow(0.5, k));
        Solution of(fixed(method, steps.back()), growth(), 1.0);
        drive(*of.integrator, {3.2, 3.2, 3.2}, {});
        const auto y = of.y.span();
        errors.push_back(std::hypot(y[0] - std::exp(std::sin(3.2)), y[1] - 1.0 / 4.2));
    }
    return observed_order(steps, errors);
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_table_has_its_order) {
    // Regression: ERKStep before SUNDIALS 6.7 runs tables with c_s = 1 wrongly (orders lost without
    // a word); those go through ARKStep.
    std::size_t tables = 0;
    for (const auto& [name, order, adaptive_too, fixed_too, separable, multistep] :
         integration_methods()) {
        if (!name.starts_with("arkode:") || order > 8) continue;
        ++tables;
        // Long enough for errors that are not rounding errors.
        const double step = order >= 6 ? 0.8 : order == 5 ? 0.2 : 0.1;
        const double observed = order_of(name, step);
        // Not below nominal; a problem may be kind to a method.
        BOOST_TEST(observed > order - 0.15, name << " has observed order " << observed);
    }
    BOOST_TEST(tables >= 15U);
    BOOST_TEST(std::abs(order_of("rk4", 0.1) - 4.0) < 0.1);
}

BOOST_AUTO_TEST_CASE(classical_rk4_is_zonneveld_with_a_fixed_step) {
    BOOST_TEST(std::abs(run(fixed("rk4", 0.1), 10.0).error -
                        run(fixed("arkode:ZONNEVELD_5_3_4", 0.1), 10.0).error) < 1e-14);
}

BOOST_AUTO_TEST_CASE(tolerances_steer_the_error) {
    const auto loose = run(adaptive("arkode:DORMAND_PRINCE_7_4_5", 1e-4, 1e-6), 20.0);
    const auto tight = run(adaptive("arkode:DORMAND_PRINCE_7_4_5", 1e-10, 1e-12), 20.0);
    BOOST_TEST(loose.error < 1e-2);
    BOOST_TEST(tight.error < 1e-8);
    BOOST_TEST(tight.error < 1e-3 * loose.error);
    BOOST_TEST(tight.statistics.steps > loose.statistics.steps);
    BOOST_TEST(tight.statistics.rhs_evaluations >= 6 * tight.statistics.steps);
}

BOOST_AUTO_TEST_CASE(fixed_steps_stay_on_their_grid_and_reach_the_end) {
    for (const char* method : {"rk4", "arkode:ZONNEVELD_5_3_4"}) {
        Solution of(fixed(method, 0.1));
        std::vector<double> outputs, steps;
        Observers observers;
        observers.output = [&](double t) { outputs.push_back(t); };
        observers.step = [&](double t) { steps.push_back(t); };
        drive(*of.integrator, {1.03, 0.25, 10.0}, observers);
        for (std::size_t n = 0; n + 1 < steps.size(); ++n)
            BOOST_TEST(steps[n] == static_cast<double>(n + 1) * 0.1);  // not accumulated
        BOOST_TEST(steps.back() == 1.03);
        BOOST_TEST(std::abs(of.y.span()[0] - std::cos(1.03)) < 2e-6);
        const std::vector<double> expected{0.0, 3 * 0.1, 5 * 0.1, 8 * 0.1, 10 * 0.1, 1.03};
        BOOST_TEST(outputs == expected, boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(adaptive_steps_land_on_output_times) {
    for (const char* method :
         {"arkode:DORMAND_PRINCE_7_4_5", "cvode:adams", "cvode:bdf", "gsl:rkf45", "gsl:msadams"}) {
        Solution of(adaptive(method));
        std::vector<double> outputs;
        Observers observers;
        observers.output = [&](double t) { outputs.push_back(t); };
        drive(*of.integrator, {1.0, 0.25, 0.4}, observers);
        const std::vector<double> expected{0.0, 0.25, 0.5, 0.75, 1.0};
        BOOST_TEST(outputs == expected, boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(a_bad_rate_stops_a_fixed_step_with_the_last_good_state) {
    for (const char* method : {"rk4", "arkode:ZONNEVELD_5_3_4", "gsl:rk4", "gsl:rk8pd"}) {
        Solution of(fixed(method, 0.1), spoilt_cosine());
        std::string reason;
        try {
            drive(*of.integrator, {1.0, 1.0, 1.0}, {});
        } catch (const GuardStop& stop) {
            reason = stop.what();
        }
        BOOST_TEST((reason.find("became nan at t = 0.5") != std::string::npos), reason);
        BOOST_TEST(of.integrator->t() == 0.4);
        BOOST_TEST(std::abs(of.y.span()[0] - std::cos(0.4)) < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(an_adaptive_step_that_cannot_succeed_stops) {
    for (const char* method :
         {"arkode:DORMAND_PRINCE_7_4_5", "cvode:adams", "cvode:bdf", "gsl:rk8pd", "gsl:msadams"}) {
        IntegratorOptions options = adaptive(method);
        options.min_step = 1e-6;
        Solution of(options, spoilt_cosine());
        BOOST_CHECK_THROW(drive(*of.integrator, {1.0, 1.0, 1.0}, {}), GuardStop);
        BOOST_TEST(of.integrator->t() <= 0.45);
        BOOST_TEST(of.integrator->t() > 0.3);
        BOOST_TEST(std::abs(of.y.span()[0] - std::cos(of.integrator->t())) < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(a_state_changed_from_outside_needs_a_reset) {
    for (const auto& options :
         {fixed("rk4", 0.01), fixed("arkode:ZONNEVELD_5_3_4", 0.01),
          adaptive("arkode:DORMAND_PRINCE_7_4_5"), adaptive("cvode:adams"), adaptive("cvode:bdf"),
          adaptive("gsl:rk8pd"), fixed("gsl:rkck", 0.01), adaptive("gsl:msadams")}) {
        Solution of(options);
        drive(*of.integrator, {0.5, 1.0, 1.0}, {});
        of.y.span()[0] = 1.0;  // back to the start
        of.y.span()[1] = 0.0;
        of.integrator->reset(0.0);
        drive(*of.integrator, {0.5, 1.0, 1.0}, {});
        BOOST_TEST(std::abs(of.y.span()[0] - std::cos(0.5)) < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(methods_that_cannot_run_are_refused) {
    const SundialsContext context;
    const Ode ode = cosine();
    Vector y(2, context);
    const auto refused = [&](const IntegratorOptions& options) {
        BOOST_CHECK_THROW(make_integrator(options, ode, y, 0.0, context), InputError);
    };
    refused(adaptive("rk4"));
    refused(fixed("rk4", -0.1));
    refused(fixed("euler", 0.1));
    refused(adaptive("arkode:NO_SUCH_TABLE"));
    refused(adaptive("arkode:KNOTH_WOLKE_3_3"));
    refused(adaptive("leapfrog"));
    refused(fixed("leapfrog", 0.1));  // this ode names no positions and velocities
    refused(fixed("cvode:adams", 0.1));
    refused(fixed("cvode:bdf", 0.1));
    refused(adaptive("gsl:bsimp"));
    refused(adaptive("arkode:DORMAND_PRINCE_7_4_5", -1.0));
    refused(adaptive("arkode:DORMAND_PRINCE_7_4_5", 1e-8, 0.0));
}

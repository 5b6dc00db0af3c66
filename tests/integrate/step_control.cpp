// SPDX-License-Identifier: GPL-3.0-or-later
// What users may say about adaptive steps, and what they are told: limits of steps, the field that keeps
// them short, why a run was stopped.
#include "support/refusal.hpp"
#include <spam/integrate/driver.hpp>
#include <spam/integrate/methods.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace spam;

namespace {

/// Two oscillators, x'' = -x as block "slow", x'' = -25 x as block "fast".
Ode oscillators() {
    Ode ode;
    ode.rates = [](double, std::span<const double> y, std::span<double> y_dot) {
        y_dot[0] = y[1];
        y_dot[1] = -y[0];
        y_dot[2] = 5.0 * y[3];
        y_dot[3] = -5.0 * y[2];
    };
    ode.failure = [] { return std::string{}; };
    ode.entry_name = [](std::size_t k) { return std::to_string(k); };
    ode.absolute_tolerance = {1e-9, 1e-9, 1e-9, 1e-9};
    ode.blocks = {{"slow", 0, 2}, {"fast", 2, 2}};
    return ode;
}

struct Run {
    const SundialsContext context;
    Vector y{4, context};
    std::unique_ptr<Integrator> integrator;
    std::vector<double> steps;

    Run(const IntegratorOptions& options, const Ode& ode) {
        y.span()[0] = y.span()[2] = 1.0;
        integrator = make_integrator(options, ode, y, 0.0, context);
    }
    const Integrator::Statistics& to(double t_end) {
        while (integrator->t() < t_end) {
            integrator->step(t_end);
            steps.push_back(integrator->statistics().last_step);
        }
        return integrator->statistics();
    }
    std::string reason(double t_end) {
        try {
            to(t_end);
        } catch (const GuardStop& stop) {
            return stop.what();
        }
        return "none";
    }
};

std::vector<IntegratorOptions> adaptive_methods() {
    std::vector<IntegratorOptions> all;
    for (const auto& method : integration_methods()) {
        if (!method.adaptive) continue;
        all.emplace_back();
        all.back().method = method.name;
        all.back().rtol = 1e-6;
    }
    return all;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// The latest time of a step at which the method asks for rates, as a share of the step: 1/2 for the midpoint
/// method, which accepts steps whose end it has not seen.
double looks_ahead(IntegratorOptions options) {
    Ode ode = oscillators();
    double latest = 0.0;
    ode.rates = [&latest, rates = ode.rates](double t, std::span<const double> y,
                                             std::span<double> y_dot) {
        latest = std::max(latest, t);
        rates(t, y, y_dot);
    };
    if (!options.dt) options.initial_step = 1e-4;  // none that is tried before
    Run run(options, ode);
    run.integrator->step(1.0);
    return std::min(1.0, latest / run.integrator->t());
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_field_that_limits_steps_is_known) {
    for (const auto& options : adaptive_methods()) {
        BOOST_TEST_CONTEXT(options.method) {
            Ode ode = oscillators();
            const auto fast = Run(options, ode).to(10.0);
            // An estimate that is exactly zero, which GSL's rk4 makes now and then, blames no field.
            const auto blamed = [](const auto& s) { return s.limited_by[0] + s.limited_by[1]; };
            BOOST_TEST(fast.limited_by[1] > 9 * fast.limited_by[0]);
            BOOST_TEST(blamed(fast) <= fast.steps);
            BOOST_TEST(blamed(fast) + 2 >= fast.steps);
            BOOST_TEST(fast.error_share[1] > 0.9 * static_cast<double>(blamed(fast)));
            BOOST_TEST(
                std::abs(std::accumulate(fast.error_share.begin(), fast.error_share.end(), 0.0) -
                         static_cast<double>(blamed(fast))) < 1e-9);
            // Allow the fast one much more: the slow one limits, and steps are longer. Small weights
            // do not make fast oscillations of explicit methods stable, so not for ever.
            ode.absolute_tolerance[2] = ode.absolute_tolerance[3] = 1e6;
            // Not from the first, tiny step, whose errors are rounding errors.
            IntegratorOptions from_there = options;
            from_there.initial_step = 0.05;
            const auto slow = Run(from_there, ode).to(1.0);
            BOOST_TEST(slow.limited_by[0] + 2 >= slow.steps);
        }
    }
}

BOOST_AUTO_TEST_CASE(steps_keep_the_limits_asked_for) {
    const Ode ode = oscillators();
    for (auto options : adaptive_methods()) {
        BOOST_TEST_CONTEXT(options.method) {
            options.rtol = 1e-3;
            options.max_step = 0.01;
            options.initial_step = 1e-4;
            Run run(options, ode);
            run.to(0.3);
            BOOST_TEST(*std::max_element(run.steps.begin(), run.steps.end()) < 0.01 * (1 + 1e-9));
            BOOST_TEST(std::abs(run.steps.front() / 1e-4 - 1.0) < 1e-9);
            BOOST_TEST(run.steps.size() >= 30U);
        }
    }
}

BOOST_AUTO_TEST_CASE(controllers_and_safety_change_steps) {
    const Ode ode = oscillators();
    IntegratorOptions options;
    options.method = "arkode:DORMAND_PRINCE_7_4_5";
    std::vector<std::vector<double>> all;
    for (const auto& name : arkode_controllers()) {
        options.controller = name;
        Run run(options, ode);
        run.to(10.0);
        BOOST_TEST(std::abs(run.y.span()[0] - std::cos(10.0)) < 1e-6);
        // Two Gustafsson controllers differ only for implicit methods.
        if (name != "imex_gustafsson")
            BOOST_TEST((std::find(all.begin(), all.end(), run.steps) == all.end()), name);
        all.push_back(run.steps);
    }
    options.controller.clear();
    Run standard(options, ode), careful(options, ode);
    options.safety = 0.5;
    Run half(options, ode);
    BOOST_TEST(standard.to(10.0).steps == careful.to(10.0).steps);
    BOOST_TEST((all.front() == standard.steps));  // pid
    BOOST_TEST(half.to(10.0).steps > 1.5 * static_cast<double>(standard.steps.size()));
}

BOOST_AUTO_TEST_CASE(too_many_steps_stop_a_run) {
    const Ode ode = oscillators();
    auto methods = adaptive_methods();
    methods.emplace_back();
    methods.back().dt = 0.01;
    for (auto& options : methods) {
        options.max_steps = 7;
        Run run(options, ode);
        const std::string reason = run.reason(100.0);
        BOOST_TEST(has(reason, "too many steps: 7"), reason);
        BOOST_TEST(run.integrator->statistics().steps == 7U);
        BOOST_TEST(has(reason, "--max-steps"));
    }
}

BOOST_AUTO_TEST_CASE(steps_that_are_never_short_enough_stop_a_run) {
    Ode ode = oscillators();
    const auto smooth = ode.rates;
    ode.rates = [smooth](double t, std::span<const double> y, std::span<double> y_dot) {
        smooth(t, y, y_dot);
        if (t > 0.5) y_dot[3] += 1e4 * std::sin(1e12 * (t + y[2]));  // noise, whatever the step
    };
    for (auto options : adaptive_methods()) {
        BOOST_TEST_CONTEXT(options.method) {
            options.min_step = 1e-5;
            Run run(options, ode);
            const std::string reason = run.reason(10.0);
            BOOST_TEST((has(reason, "again and again") || has(reason, "did not converge")), reason);
            if (has(reason, "again and again"))
                BOOST_TEST(has(reason, "limited by the fast"), reason);
            BOOST_TEST(has(reason, "least allowed 1e-05"), reason);
            BOOST_TEST(run.integrator->t() < 0.51);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_reason_of_the_model_is_what_users_are_told) {
    Ode ode = oscillators();
    const auto good = ode.rates;
    auto failure = std::make_shared<std::string>();
    ode.rates = [good, failure](double t, std::span<const double> y, std::span<double> y_dot) {
        good(t, y, y_dot);
        *failure = t > 0.45 ? "density of particle 3 became negative" : "";
        if (t > 0.45) y_dot[1] = std::nan("");
    };
    ode.failure = [failure] { return *failure; };
    auto methods = adaptive_methods();
    for (const auto& method : integration_methods())
        if (method.fixed && !method.separable && method.order > 1) {  // Euler does not look ahead
            methods.emplace_back();
            methods.back().method = method.name;
            methods.back().dt = 0.05;
        }
    for (auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            options.min_step = 1e-7;
            Run run(options, ode);
            const std::string reason = run.reason(10.0);
            BOOST_TEST(has(reason, "density of particle 3 became negative at t = 0.4"), reason);
            const double t = run.integrator->t(), unseen = 1.0 - looks_ahead(options);
            BOOST_TEST(t <= 0.45 + 1e-9 + unseen * run.integrator->statistics().last_step);
            BOOST_TEST(unseen <= 0.5);
            BOOST_TEST(t > 0.3);
            BOOST_TEST(std::abs(run.y.span()[0] - std::cos(t)) < 1e-3);
        }
    }
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused) {
    const Ode ode = oscillators();
    const auto reason = [&](const IntegratorOptions& options, const Ode& of) {
        return test::refusal([&] { Run(options, of); });
    };
    IntegratorOptions o;
    o.method = "leapfrog";
    BOOST_TEST(has(reason(o, ode), "dt: leapfrog needs a fixed step"));
    o.dt = 0.1;
    BOOST_TEST(has(reason(o, ode), "y holds slow as well"), reason(o, ode));
    Ode damped = ode;
    damped.inseparable = "its friction depends on the velocity";
    BOOST_TEST(has(reason(o, damped), "its friction depends on the velocity"));
    for (const char* method : {"cvode:adams", "cvode:bdf", "gsl:msadams"}) {
        o.method = method;
        BOOST_TEST(has(reason(o, ode), "leave --dt out"));
        IntegratorOptions adaptive;
        adaptive.method = method;
        Ode with_event = ode;
        with_event.events.push_back({"bounce", {}, {}, 1e-12, {}});
        BOOST_TEST(has(reason(adaptive, with_event), "cannot end one at bounce"));
    }
    for (const char* method : {"gsl:rk2imp", "gsl:msbdf"}) {
        o.method = method;
        BOOST_TEST(has(reason(o, ode), "Jacobian"), reason(o, ode));
    }
    o.method = "rk4";
    o.field_atol = {{"stress", 1e-3}};
    BOOST_TEST(has(reason(o, ode), "atol-stress: y holds no stress"));
    o.field_atol.clear();
    o.max_step = 1e-13;
    o.min_step = 1e-12;
    BOOST_TEST(has(reason(o, ode), "max-step"));
    o.max_step.reset();
    o.min_step.reset();
    o.controller = "pld";
    BOOST_TEST(has(reason(o, ode), "did you mean pid?"));
    o.controller.clear();
    o.safety = 1.0;
    BOOST_TEST(has(reason(o, ode), "safety"));
}

/// What changes y after every step, as a material that yields does, accumulates no times.
BOOST_AUTO_TEST_CASE(fixed_steps_stay_on_their_grid_whatever_settles) {
    for (const char* method : {"rk4", "arkode:ZONNEVELD_5_3_4", "gsl:rkck"}) {
        Ode ode = oscillators();
        ode.settle = [](double, std::span<double> y) {
            y[2] *= 0.999;
            return true;
        };
        Run run({.method = method, .dt = 0.01}, ode);
        BOOST_TEST(run.to(320.0).steps == 32000U);
        BOOST_TEST(*std::min_element(run.steps.begin(), run.steps.end()) == 0.01);
    }
}

/// An adaptive method of one step goes on with the step it has found.
BOOST_AUTO_TEST_CASE(adaptive_steps_stay_as_long_whatever_settles) {
    for (const char* method : {"arkode:DORMAND_PRINCE_7_4_5", "gsl:rkf45"}) {
        const auto steps_with = [&](bool settles) {
            Ode ode = oscillators();
            if (settles) ode.settle = [](double, std::span<double>) { return true; };
            Run run({.method = method, .dt = {}, .rtol = 1e-6}, ode);
            return run.to(20.0).steps;
        };
        BOOST_TEST(steps_with(true) <= steps_with(false) + 5U);
    }
}

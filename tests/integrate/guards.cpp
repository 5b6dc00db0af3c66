// SPDX-License-Identifier: GPL-3.0-or-later
// What cannot go on ends soon, with a reason that says where it began.
#include <spam/core/error.hpp>
#include <spam/integrate/driver.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>

using namespace spam;

namespace {

using Rates = std::function<void(double, std::span<const double>, std::span<double>)>;

IntegratorOptions with(const std::string& method, std::optional<double> dt) {
    return {.method = method, .dt = dt};
}
const IntegratorOptions rk4 = with("rk4", 0.1);
const IntegratorOptions fixed = with("arkode:ZONNEVELD_5_3_4", 0.1);
const IntegratorOptions adaptive = with("arkode:DORMAND_PRINCE_7_4_5", std::nullopt);

struct End {
    std::string reason;  ///< empty: it went on to t = 1
    double t;
    std::size_t evaluations;
    std::vector<double> y;
};

/// From y = 1 in three entries to t = 1.
End run(
    const IntegratorOptions& options, const Rates& rates,
    const std::function<std::string()>& failure = [] { return std::string{}; }) {
    const SundialsContext context;
    Ode ode;
    ode.rates = rates;
    ode.failure = failure;  // without it a model that gives no reason
    ode.entry_name = [](std::size_t k) { return "entry " + std::to_string(k); };
    ode.absolute_tolerance = {1e-10, 1e-10, 1e-10};
    Vector y(3, context);
    for (double& value : y.span()) value = 1.0;
    const auto integrator = make_integrator(options, ode, y, 0.0, context);
    End end{};
    try {
        drive(*integrator, {1.0, 1.0, 1.0}, {});
    } catch (const GuardStop& stop) {
        end.reason = stop.what();
    }
    end.t = integrator->t();
    end.evaluations = integrator->statistics().rhs_evaluations;
    end.y.assign(y.span().begin(), y.span().end());
    return end;
}

bool says(const End& end, const char* words) { return end.reason.find(words) != std::string::npos; }

/// Each entry follows the next one; from t = 0.55 on, the rate of entry 1 is none.
void poisoned(double t, std::span<const double> y, std::span<double> y_dot) {
    for (std::size_t k = 0; k < 3; ++k) y_dot[k] = y[(k + 1) % 3];
    if (t >= 0.55) y_dot[1] = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

/// Later stages spread it to entry 0, which is first in y.
BOOST_AUTO_TEST_CASE(a_rate_that_is_not_a_number_is_named_where_it_began) {
    for (const auto& options : {rk4, fixed, adaptive}) {
        const End end = run(options, poisoned);
        BOOST_TEST_CONTEXT(options.method << ": " << end.reason) {
            BOOST_TEST(says(end, "the rate of entry 1 became nan at t = 0.55"));
            BOOST_TEST((end.t > 0.49 && end.t < 0.551));
            BOOST_TEST(end.evaluations < 5000u);
            for (const double value : end.y) BOOST_TEST(std::isfinite(value));
        }
    }
}

/// Entry 2, an energy, falls below zero at t = 0.5 however short the step is. The rates then are not numbers,
/// and a later stage, which is made of them, complains of its positions.
BOOST_AUTO_TEST_CASE(the_first_complaint_of_a_step_is_the_reason) {
    std::string complaint;
    const auto cooling = [&](double, std::span<const double> y, std::span<double> y_dot) {
        complaint = !std::isfinite(y[0]) ? "a position is not finite"
                    : y[2] < 0.0         ? "an energy is outside the law"
                                         : "";
        y_dot[0] = y[1];
        y_dot[1] = -y[0];
        y_dot[2] = -2.0;
        if (!complaint.empty())
            std::fill(y_dot.begin(), y_dot.end(), std::numeric_limits<double>::quiet_NaN());
    };
    for (const auto& options :
         {rk4, fixed, adaptive, with("arkode:BOGACKI_SHAMPINE_4_2_3", std::nullopt),
          with("gsl:rkf45", std::nullopt)}) {
        const End end = run(options, cooling, [&] { return complaint; });
        BOOST_TEST_CONTEXT(options.method << ": " << end.reason) {
            BOOST_TEST(says(end, "an energy is outside the law at t = "));
            BOOST_TEST((end.t > 0.39 && end.t < 0.501));
            for (const double value : end.y) BOOST_TEST(std::isfinite(value));
        }
    }
}

BOOST_AUTO_TEST_CASE(what_is_not_poisoned_goes_on) {
    const auto sound = [](double, std::span<const double> y, std::span<double> y_dot) {
        poisoned(0.0, y, y_dot);
    };
    for (const auto& options : {rk4, fixed, adaptive}) BOOST_TEST(run(options, sound).reason == "");
}

/// A spring of omega = 1e20: a fixed step explodes, an adaptive one falls below the least.
BOOST_AUTO_TEST_CASE(a_spring_too_stiff_for_any_step) {
    const auto spring = [](double, std::span<const double> y, std::span<double> y_dot) {
        y_dot[0] = y[1];
        y_dot[1] = -1e40 * y[0];
        y_dot[2] = 0.0;
    };
    for (const auto& options : {rk4, fixed}) {
        const End end = run(options, spring);
        BOOST_TEST_CONTEXT(options.method << ": " << end.reason) {
            BOOST_TEST((says(end, "infinite") || says(end, "nan")));
            BOOST_TEST(end.evaluations < 100u);
            for (const double value : end.y) BOOST_TEST(std::isfinite(value));
        }
    }
    const End end = run(adaptive, spring);
    BOOST_TEST_CONTEXT(end.reason) {
        BOOST_TEST(says(end, "step"));
        BOOST_TEST(end.evaluations < 5000u);
    }
}

/// Rates without any relation between one time and the next: no step is short enough.
BOOST_AUTO_TEST_CASE(steps_rejected_again_and_again) {
    const auto noise = [](double t, std::span<const double>, std::span<double> y_dot) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &t, sizeof bits);
        for (double& rate : y_dot) {
            bits = bits * 6364136223846793005u + 1442695040888963407u;
            rate = 1e12 * (static_cast<double>(bits >> 11) * 0x1p-52 - 1.0);
        }
    };
    const End end = run(adaptive, noise);
    BOOST_TEST_CONTEXT(end.reason) {
        BOOST_TEST(says(end, "step"));
        BOOST_TEST(end.t < 1e-3);
        BOOST_TEST(end.evaluations < 20'000u);
    }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Events between steps, on a ball that bounces: y = (height, speed), height'' = -1, known to the last
// digit between bounces (every method here is exact for parabolas).
#include <spam/core/error.hpp>
#include <spam/integrate/driver.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace spam;

namespace {

/// A bounce keeps `restitution` of the speed.
Event bounce(double restitution, std::vector<double>& times) {
    Event event;
    event.name = "bounce";
    event.distance = [](double, std::span<const double> y) { return y[0]; };
    event.apply = [restitution, &times](double t, std::span<double> y) -> std::size_t {
        times.push_back(t);
        y[1] *= -restitution;
        return 1;
    };
    return event;
}

Ode ball() {
    Ode ode;
    ode.rates = [](double, std::span<const double> y, std::span<double> y_dot) {
        y_dot[0] = y[1];
        y_dot[1] = -1.0;
    };
    ode.failure = [] { return std::string{}; };
    ode.entry_name = [](std::size_t k) { return std::to_string(k); };
    ode.absolute_tolerance = {1e-12, 1e-12};
    ode.blocks = {{"position", 0, 1}, {"velocity", 1, 1}};
    return ode;
}

IntegratorOptions with(const std::string& method, std::optional<double> dt) {
    return {.method = method, .dt = dt};
}

/// Fixed and adaptive, and a table that goes through ARKStep.
const std::vector<IntegratorOptions> methods{with("rk4", 0.1),
                                             with("rk4", 1.7),
                                             with("arkode:ZONNEVELD_5_3_4", 0.1),
                                             with("arkode:DORMAND_PRINCE_7_4_5", std::nullopt),
                                             with("arkode:VERNER_8_5_6", 0.1),
                                             with("arkode:VERNER_8_5_6", std::nullopt),
                                             with("leapfrog", 0.1),
                                             with("leapfrog", 1.7),
                                             with("gsl:rk2", 0.1),
                                             with("gsl:rk8pd", 0.1),
                                             with("gsl:rkf45", std::nullopt),
                                             with("gsl:rk8pd", std::nullopt)};

struct Fall {
    const SundialsContext context;
    Ode ode = ball();
    Vector y{2, context};
    std::vector<double> bounces, steps;
    std::unique_ptr<Integrator> integrator;

    Fall(const IntegratorOptions& options, double restitution, double height = 0.5) {
        y.span()[0] = height;
        ode.events.push_back(bounce(restitution, bounces));
        integrator = make_integrator(options, ode, y, 0.0, context);
    }
    void run(double t_end) {
        Observers observers;
        observers.step = [&](double t) { steps.push_back(t); };
        drive(*integrator, {t_end, t_end, t_end}, observers);
    }
    double energy() const { return y.span()[0] + 0.5 * y.span()[1] * y.span()[1]; }
};

}  // namespace

BOOST_AUTO_TEST_CASE(events_are_found_at_their_times) {
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Fall fall(options, 1.0);  // falls for a time 1, then bounces at 1, 3, 5, ...
            fall.run(10.5);
            BOOST_TEST(fall.bounces.size() == 5U);
            for (std::size_t k = 0; k < fall.bounces.size(); ++k)
                BOOST_TEST(std::abs(fall.bounces[k] - static_cast<double>(2 * k + 1)) < 1e-11);
            BOOST_TEST(fall.integrator->statistics().events == 5U);
            BOOST_TEST(std::abs(fall.y.span()[0] - 0.375) < 1e-11);
            BOOST_TEST(std::abs(fall.energy() - 0.5) < 1e-13);
        }
    }
}

BOOST_AUTO_TEST_CASE(fixed_steps_stay_on_their_grid) {
    for (const char* method : {"rk4", "arkode:ZONNEVELD_5_3_4", "leapfrog", "gsl:rkck"}) {
        Fall fall(with(method, 0.3), 1.0);
        fall.run(20.2);
        for (std::size_t n = 0; n + 1 < fall.steps.size(); ++n)
            BOOST_TEST(fall.steps[n] == static_cast<double>(n + 1) * 0.3);  // not accumulated
        BOOST_TEST(fall.steps.back() == 20.2);
        BOOST_TEST(fall.integrator->statistics().steps == fall.steps.size());
        BOOST_TEST(fall.integrator->statistics().last_step < 0.3);
    }
}

BOOST_AUTO_TEST_CASE(adaptive_steps_end_at_events) {
    Fall fall(with("arkode:DORMAND_PRINCE_7_4_5", std::nullopt), 1.0);
    fall.run(10.5);
    for (const double t : fall.bounces)
        BOOST_TEST((std::find(fall.steps.begin(), fall.steps.end(), t) != fall.steps.end()));
    BOOST_TEST(fall.steps.size() < 60U);
}

BOOST_AUTO_TEST_CASE(several_events_in_one_step) {
    // Bounces at half the speed after 1, 2, 2.5, ...: four within one step.
    Fall fall(with("rk4", 2.8), 0.5);
    fall.run(2.8);
    const std::vector<double> expected{1.0, 2.0, 2.5, 2.75};
    BOOST_TEST(fall.bounces.size() == expected.size());
    for (std::size_t k = 0; k < std::min(expected.size(), fall.bounces.size()); ++k)
        BOOST_TEST(std::abs(fall.bounces[k] - expected[k]) < 1e-10);
    BOOST_TEST(fall.integrator->statistics().steps == 1U);
}

BOOST_AUTO_TEST_CASE(events_of_two_kinds) {
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Fall fall(options, 1.0);
            std::vector<double> rings;
            Event ring;  // a bell at t = 3, together with a bounce, and later ones alone
            ring.name = "bell";
            auto next = std::make_shared<double>(3.0);
            ring.distance = [next](double t, std::span<const double>) { return *next - t; };
            ring.apply = [next, &rings](double t, std::span<double>) -> std::size_t {
                rings.push_back(t);
                *next += 1.5;
                return 1;
            };
            fall.ode.events.push_back(ring);
            fall.run(6.2);
            BOOST_TEST(fall.bounces.size() == 3U);
            BOOST_TEST(rings.size() == 3U);
            for (std::size_t k = 0; k < std::min<std::size_t>(3, rings.size()); ++k)
                BOOST_TEST(std::abs(rings[k] - 3.0 - 1.5 * static_cast<double>(k)) < 1e-11);
            BOOST_TEST(std::abs(fall.energy() - 0.5) < 1e-13);
            BOOST_TEST(fall.integrator->statistics().events == 6U);
        }
    }
}

BOOST_AUTO_TEST_CASE(events_that_follow_each_other_ever_faster_stop_the_run) {
    // After 1, 2, 2.5, ... time would never reach 3.
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Fall fall(options, 0.5);
            std::string reason;
            try {
                fall.run(10.0);
            } catch (const GuardStop& stop) {
                reason = stop.what();
            }
            BOOST_TEST(reason.find("bounce") != std::string::npos, reason);
            BOOST_TEST(reason.find("events") != std::string::npos, reason);
            BOOST_TEST(std::abs(fall.integrator->t() - 3.0) < 1e-4);
            BOOST_TEST(std::abs(fall.y.span()[0]) < 1e-8);  // the state of the last event
            BOOST_TEST(fall.bounces.back() == fall.integrator->t());
        }
    }
}

BOOST_AUTO_TEST_CASE(an_event_that_stays_due_stops_the_run) {
    for (const auto& options : methods) {
        Fall fall(options, 1.0);
        fall.ode.events.front().apply = [](double, std::span<double>) -> std::size_t { return 0; };
        std::string reason;
        try {
            fall.run(10.0);
        } catch (const GuardStop& stop) {
            reason = stop.what();
        }
        BOOST_TEST(reason.find("bounce") != std::string::npos, reason);
        BOOST_TEST(std::abs(fall.integrator->t() - 1.0) < 1e-6);
        BOOST_TEST(fall.integrator->statistics().events == 0U);
    }
}

BOOST_AUTO_TEST_CASE(steps_too_long_to_watch_are_shortened) {
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Fall fall(options, 1.0);
            Event& event = fall.ode.events.front();
            auto begin = std::make_shared<double>(0.0);
            event.arm = [begin](double t, std::span<const double>) { *begin = t; };
            const auto watched = event.distance;
            event.distance = [begin, watched](double t, std::span<const double> y) {
                return t - *begin > 0.06 ? -std::numeric_limits<double>::infinity() : watched(t, y);
            };
            fall.run(10.5);
            BOOST_TEST(fall.bounces.size() == 5U);
            BOOST_TEST(std::abs(fall.y.span()[0] - 0.375) < 1e-10);
        }
    }
    Fall never(methods.front(), 1.0);
    never.ode.events.front().distance = [](double, std::span<const double>) {
        return -std::numeric_limits<double>::infinity();
    };
    BOOST_CHECK_THROW(never.run(1.0), GuardStop);
}

BOOST_AUTO_TEST_CASE(a_reset_begins_anew) {
    for (const auto& options : methods) {
        BOOST_TEST_CONTEXT(options.describe()) {
            Fall fall(options, 1.0);
            fall.run(3.3);
            fall.y.span()[0] = 0.5;  // back to the start
            fall.y.span()[1] = 0.0;
            fall.integrator->reset(0.0);
            fall.bounces.clear();
            fall.run(3.3);
            BOOST_TEST(fall.bounces.size() == 2U);
            BOOST_TEST(std::abs(fall.bounces.back() - 3.0) < 1e-11);
        }
    }
}

BOOST_AUTO_TEST_CASE(events_that_never_happen_change_no_bit) {
    for (const auto& options : methods) {
        Fall with_event(options, 1.0, 100.0), without(options, 1.0, 100.0);
        without.ode.events.clear();
        with_event.run(5.0);
        without.run(5.0);
        BOOST_TEST(with_event.y.span()[0] == without.y.span()[0]);
        BOOST_TEST(with_event.integrator->statistics().rhs_evaluations ==
                   without.integrator->statistics().rhs_evaluations);
    }
}

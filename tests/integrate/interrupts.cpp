// SPDX-License-Identifier: GPL-3.0-or-later
// A signal ends a step among its events, and what was left of the step is taken later, bit for bit.
// What a signal does between results. (A file of its own: a signal received is never forgotten.)
#include <spam/integrate/integrator.hpp>
#include <spam/integrate/interrupt.hpp>

#include <boost/test/unit_test.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

using namespace spam;

namespace {

/// A ball that loses a little at each of many bounces within a step of 1.
struct Ball {
    const SundialsContext context;
    Ode ode;
    Vector y{2, context};
    std::size_t bounces = 0, signal_at = 0;
    std::unique_ptr<Integrator> integrator;

    explicit Ball(const std::string& method) {
        ode.rates = [](double, std::span<const double> z, std::span<double> z_dot) {
            z_dot[0] = z[1];
            z_dot[1] = -1.0;
        };
        ode.failure = [] { return std::string{}; };
        ode.entry_name = [](std::size_t k) { return std::to_string(k); };
        ode.absolute_tolerance = {1e-12, 1e-12};
        Event event;
        event.name = "bounce";
        event.distance = [](double, std::span<const double> z) { return z[0]; };
        event.apply = [this](double, std::span<double> z) -> std::size_t {
            z[1] *= -0.99;
            if (++bounces == signal_at) std::raise(SIGINT);
            return 1;
        };
        ode.events.push_back(event);
        y.span()[0] = 1e-3;
        IntegratorOptions options;
        options.method = method;
        options.dt = 1.0;
        integrator = make_integrator(options, ode, y, 0.0, context);
    }
    std::vector<double> state() { return {y.span().begin(), y.span().end()}; }
};

/// Exit status of a process of its own that does this.
int status_of(const std::function<void()>& what) {
    std::signal(SIGCHLD, SIG_DFL);  // Boost.Test would take the child's status for a failure
    const pid_t child = fork();
    if (child == 0) {
        close(STDERR_FILENO);
        const InterruptWatch watch("test");
        InterruptWatch::complete_results();
        what();
        _exit(InterruptWatch::received() == SIGINT ? 7 : 8);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

/// First here: no signal has been received yet.
BOOST_AUTO_TEST_CASE(computations_between_results_end_at_once) {
    BOOST_TEST(status_of([] { std::raise(SIGINT); }) == 7);
    BOOST_TEST(status_of([] { const InterruptWatch::AtOnce at_once; }) == 8);
    BOOST_TEST(status_of([] {
                   const InterruptWatch::AtOnce at_once;
                   std::raise(SIGINT);
               }) == 130);
    BOOST_TEST(status_of([] {
                   std::raise(SIGINT);
                   const InterruptWatch::AtOnce at_once;
               }) == 130);
    BOOST_TEST(status_of([] {
                   { const InterruptWatch::AtOnce at_once; }
                   std::raise(SIGINT);
               }) == 7);
    // Two at once are one, as timeout(1) sends them; a later one ends the process by itself.
    const auto twice = [](unsigned microseconds) {
        return status_of([microseconds] {
            std::raise(SIGINT);
            usleep(microseconds);
            std::raise(SIGINT);
        });
    };
    BOOST_TEST(twice(0) == 7);
    BOOST_TEST(twice(100'000) == 7);
    BOOST_TEST(twice(600'000) == -1);
}

BOOST_AUTO_TEST_CASE(a_signal_ends_a_step_at_its_next_event) {
    Ball rk4("rk4"), arkode("arkode:ZONNEVELD_5_3_4");
    for (Ball* ball : {&rk4, &arkode})
        for (int n = 0; n < 2; ++n) ball->integrator->step(2.0);
    for (const auto& [method, whole] :
         {std::pair{"rk4", &rk4}, {"arkode:ZONNEVELD_5_3_4", &arkode}})
        BOOST_TEST_CONTEXT(method) {
            const InterruptWatch watch("test");  // each catches one signal
            InterruptWatch::complete_results();
            BOOST_REQUIRE(whole->bounces > 10u);
            Ball cut(method);
            cut.signal_at = 5;
            const double t = cut.integrator->step(2.0);
            BOOST_TEST(t < 1.0);
            BOOST_TEST(cut.bounces <= 5u);
            BOOST_TEST(cut.integrator->t() == t);
            for (int k = 0; k < 10'000 && cut.integrator->t() < 2.0; ++k) cut.integrator->step(2.0);
            BOOST_TEST(cut.bounces == whole->bounces);
            BOOST_TEST((cut.state() == whole->state()));
            BOOST_TEST(cut.integrator->statistics().steps == 2u);
        }
}

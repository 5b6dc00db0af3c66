// SPDX-License-Identifier: GPL-3.0-or-later
// cvode:bdf where something decays much faster than the motion goes: a chain with strong friction under a slow load.
#include <spam/core/error.hpp>
#include <spam/integrate/integrator.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace spam;

namespace {

constexpr std::size_t n = 20;

/// n masses, springs with x^3 between them, the first one held, friction gamma; on the last one the load grows to
/// 0.1 at t = duration. y = [x | v | work], the work of load and friction.
struct Chain {
    double gamma = 3.0, duration = 300.0;

    double load(double t) const { return 0.1 * t / duration; }
    static double force(double u) { return u + u * u * u; }
    Ode ode() const {
        Ode ode;
        ode.rates = [*this](double t, std::span<const double> y, std::span<double> y_dot) {
            double power = load(t) * y[2 * n - 1];
            for (std::size_t i = 0; i < n; ++i) {
                const double before = force(y[i] - (i > 0 ? y[i - 1] : 0.0));
                const double after = i + 1 < n ? force(y[i + 1] - y[i]) : load(t);
                y_dot[i] = y[n + i];
                y_dot[n + i] = after - before - gamma * y[n + i];
                power -= gamma * y[n + i] * y[n + i];
            }
            y_dot[2 * n] = power;
        };
        ode.failure = [] { return std::string{}; };
        ode.entry_name = [](std::size_t k) { return std::to_string(k); };
        ode.absolute_tolerance.assign(2 * n, 1e-8);
        ode.absolute_tolerance.push_back(std::numeric_limits<double>::infinity());
        ode.blocks = {{"position", 0, n}, {"velocity", n, n}};
        ode.accounts = 1;
        return ode;
    }
    static double energy(std::span<const double> y) {
        double sum = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            const double u = y[i] - (i > 0 ? y[i - 1] : 0.0);
            sum += 0.5 * y[n + i] * y[n + i] + 0.5 * u * u + 0.25 * u * u * u * u;
        }
        return sum;
    }
};

struct End {
    std::vector<double> y;
    std::size_t rhs_evaluations;
};

End end_of(const Chain& chain, const char* method, double tolerance) {
    const SundialsContext context;
    Ode ode = chain.ode();
    std::fill_n(ode.absolute_tolerance.begin(), 2 * n, tolerance);
    Vector y(2 * n + 1, context);
    IntegratorOptions options;
    options.method = method;
    options.rtol = tolerance;
    const auto integrator = make_integrator(options, ode, y, 0.0, context);
    while (integrator->t() < chain.duration) integrator->step(chain.duration);
    const auto at = std::as_const(y).span();
    return {{at.begin(), at.end()}, integrator->statistics().rhs_evaluations};
}

double difference(const End& a, const End& b) {
    double largest = 0.0;
    for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(a.y[k] - b.y[k]));
    return largest;
}

}  // namespace

// Steps of explicit methods are as short as the fastest decay, those of backward differences as the motion is smooth.
BOOST_AUTO_TEST_CASE(strong_friction_costs_explicit_methods_more) {
    const Chain chain;
    const End exact = end_of(chain, "arkode:DORMAND_PRINCE_7_4_5", 1e-11);
    for (const double tolerance : {1e-5, 1e-7}) {
        const End bdf = end_of(chain, "cvode:bdf", tolerance),
                  other = end_of(chain, "arkode:DORMAND_PRINCE_7_4_5", tolerance);
        BOOST_TEST(difference(bdf, exact) < 200.0 * tolerance);
        // What src/integrate/README.md says.
        BOOST_TEST_MESSAGE(tolerance << ": " << bdf.rhs_evaluations << " ("
                                     << difference(bdf, exact) << ") and " << other.rhs_evaluations
                                     << " (" << difference(other, exact) << ")");
        BOOST_TEST(2 * bdf.rhs_evaluations < other.rhs_evaluations);
    }
}

// What an account holds is the work along the way, to the error of the method, although accounts have no weight
// where linear equations end.
BOOST_AUTO_TEST_CASE(accounts_are_balanced) {
    for (const double gamma : {3.0, 0.3}) {
        const Chain chain{.gamma = gamma};
        for (const double tolerance : {1e-5, 1e-7}) {
            const End end = end_of(chain, "cvode:bdf", tolerance);
            const double energy = Chain::energy(end.y);
            BOOST_TEST(energy > 0.018);
            BOOST_TEST(std::abs(end.y[2 * n] - energy) < 3.0 * tolerance,
                       gamma << ", " << tolerance << ": " << end.y[2 * n] - energy);
        }
    }
}

// A right-hand side without meaning shortens the step, and one that never has any ends the run with the last good
// state.
BOOST_AUTO_TEST_CASE(what_has_no_meaning_stops_it) {
    Chain chain;
    const SundialsContext context;
    Ode ode = chain.ode();
    const auto good = ode.rates;
    bool bad = false;
    ode.rates = [&](double t, std::span<const double> y, std::span<double> y_dot) {
        good(t, y, y_dot);
        bad = t > 40.0;
    };
    ode.failure = [&] { return std::string(bad ? "no meaning" : ""); };
    Vector y(2 * n + 1, context);
    IntegratorOptions options;
    options.method = "cvode:bdf";
    options.min_step = 1e-6;
    const auto integrator = make_integrator(options, ode, y, 0.0, context);
    BOOST_CHECK_THROW(while (integrator->t() < 50.0) integrator->step(50.0), GuardStop);
    BOOST_TEST(integrator->t() <= 40.0);
    BOOST_TEST(integrator->t() > 39.0);
    for (const double number : std::as_const(y).span()) BOOST_TEST(std::isfinite(number));
}

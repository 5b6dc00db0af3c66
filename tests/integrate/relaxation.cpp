// SPDX-License-Identifier: GPL-3.0-or-later
// Steps that are rescaled to keep the energy: its gradient, how well it is kept, where steps end, and what is
// refused. What needs ARKODE's relaxation is not tried before SUNDIALS 6.6, where it is refused.
#include "support/refusal.hpp"
#include "support/small_hexagons.hpp"
#include <spam/external/friction.hpp>
#include <spam/integrate/driver.hpp>
#include <spam/rhs/pair_potentials.hpp>

#include <boost/test/unit_test.hpp>
#include <sundials/sundials_config.h>

using namespace spam;
using namespace spam::test;

namespace {

constexpr bool available = 100 * SUNDIALS_VERSION_MAJOR + SUNDIALS_VERSION_MINOR >= 606;

/// Molecular dynamics with a pair potential.
std::unique_ptr<System> potential_hexagon(int n, double amplitude) {
    return shaken(std::make_unique<PairPotentialModel<2>>(
                      make_particles<2>(triangular_hexagon(n), 1.0), 2.85),
                  amplitude);
}

using MakeSystem = std::unique_ptr<System> (*)(int, double);
const std::vector<std::pair<std::string, MakeSystem>> systems{
    {"smooth", smooth_hexagon}, {"bonded", bonded_hexagon}, {"potential", potential_hexagon}};

IntegratorOptions relaxed(const std::string& method, double rtol = 1e-6) {
    IntegratorOptions options;
    options.method = method;
    options.rtol = rtol;
    options.relaxation = true;
    return options;
}

/// A state of the system on its way, where nothing is zero.
std::vector<double> moved(const System& system) {
    const SundialsContext context;
    Vector y = start_of(system, context);
    const auto integrator = make_integrator({.dt = 0.05}, system.ode, y, 0.0, context);
    drive(*integrator, {1.0, 1.0, 1.0}, {});
    return {y.span().begin(), y.span().end()};
}

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
}

/// |dE/dy . rates| over the sum of the sizes of its terms.
double power(const System& system) {
    const auto y = moved(system);
    std::vector<double> gradient(y.size()), y_dot(y.size());
    system.ode.energy_gradient(0.0, y, gradient);
    system.ode.rates(0.0, y, y_dot);
    double terms = 0.0;
    for (std::size_t k = 0; k < y.size(); ++k) terms += std::abs(gradient[k] * y_dot[k]);
    return std::abs(dot(gradient, y_dot)) / terms;
}

/// Largest difference between the gradient and the slope of the energy.
double slope_error(const System& system) {
    auto y = moved(system);
    std::vector<double> gradient(y.size());
    system.ode.energy_gradient(0.0, y, gradient);
    double error = 0.0;
    for (std::size_t k = 0; k < y.size(); ++k) {
        constexpr double h = 1e-5;
        const double at = y[k];
        y[k] = at + h;
        const double above = system.ode.energy(y);
        y[k] = at - h;
        const double below = system.ode.energy(y);
        y[k] = at;
        error = std::max(error, std::abs((above - below) / (2.0 * h) - gradient[k]));
    }
    return error;
}

std::unique_ptr<System> damped(std::unique_ptr<System> system) {
    dynamic_cast<ParticleModel<2>&>(*system->model).add(std::make_unique<Friction<2>>(0.1));
    return shaken(std::move(system->model), 0.3);
}

struct Kept {
    double drift = 0.0;  ///< largest |E - E(0)| / E(0)
    std::vector<double> y{}, outputs{};
    Integrator::Statistics statistics{};
};

Kept run(const System& system, const IntegratorOptions& options, double t_end) {
    const SundialsContext context;
    Vector y = start_of(system, context);
    const auto integrator = make_integrator(options, system.ode, y, 0.0, context);
    const double before = system.ode.energy(y.span());
    Kept kept;
    Observers observers;
    observers.step = [&](double) {
        const double change = std::abs(system.ode.energy(y.span()) / before - 1.0);
        kept.drift = std::max(kept.drift, change);
    };
    observers.output = [&](double t) { kept.outputs.push_back(t); };
    drive(*integrator, {t_end, 2.5, t_end}, observers);
    kept.y.assign(y.span().begin(), y.span().end());
    kept.statistics = integrator->statistics();
    return kept;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_gradient_is_the_slope_of_the_energy) {
    for (const auto& [name, make] : systems) BOOST_TEST(slope_error(*make(1, 0.3)) < 1e-7, name);
    // Friction is no part of a potential.
    BOOST_TEST(slope_error(*damped(bonded_hexagon(1, 0.3))) > 1e-3);
}

BOOST_AUTO_TEST_CASE(rates_do_no_work_along_the_gradient) {
    // By construction where y = (x, v); with energies in y it is what the scheme promises.
    BOOST_TEST(power(*smooth_hexagon(2, 0.3)) < 1e-14);
    const auto system = damped(smooth_hexagon(2, 0.3));
    BOOST_TEST(why_no_energy(*system->model) == "externals change it");
    BOOST_TEST(power(*system) > 1e-3);
    SmoothParticleModel<2> with_core(make_particles<2>(triangular_hexagon(2), 1.0),
                                     ElasticSolid::triangular_lattice(), Scheme{});
    BOOST_TEST(why_no_energy<2>(with_core) == "");
    with_core.add_term<Core<2>>(CorePotential{0.01, 1.0});
    BOOST_TEST(why_no_energy<2>(with_core).starts_with("a potential holds a part of it"));
}

BOOST_AUTO_TEST_CASE(rescaled_steps_keep_the_energy) {
    if (!available) return;
    constexpr double t_end = 20.0;
    for (const auto& [name, make] : systems) {
        const auto exact = run(
            *make(2, 0.1),
            [] {
                auto options = relaxed("arkode:FEHLBERG_13_7_8", 1e-12);
                options.relaxation = false;
                return options;
            }(),
            t_end);
        for (const char* method : {"arkode:BOGACKI_SHAMPINE_4_2_3", "arkode:ZONNEVELD_5_3_4",
                                   "arkode:CASH_KARP_6_4_5", "arkode:VERNER_8_5_6"}) {
            BOOST_TEST_CONTEXT(name << ", " << method) {
                auto options = relaxed(method);
                const Kept with = run(*make(2, 0.1), options, t_end);
                options.relaxation = false;
                const Kept without = run(*make(2, 0.1), options, t_end);
                BOOST_TEST_MESSAGE(name << " " << method << ": drift " << without.drift << " -> "
                                        << with.drift << ", steps " << without.statistics.steps
                                        << " -> " << with.statistics.steps << ", rates "
                                        << without.statistics.rhs_evaluations << " -> "
                                        << with.statistics.rhs_evaluations << ", rejected "
                                        << without.statistics.rejected_steps << " -> "
                                        << with.statistics.rejected_steps << ", error "
                                        << largest_difference(without.y, exact.y) << " -> "
                                        << largest_difference(with.y, exact.y));
                BOOST_TEST(with.drift < 0.01 * without.drift);
                BOOST_TEST(with.drift < 1e-12);
                BOOST_TEST(largest_difference(with.y, exact.y) <
                           3.0 * largest_difference(without.y, exact.y) + 1e-6);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(rescaled_steps_land_on_output_times) {
    if (!available) return;
    const Kept kept = run(*smooth_hexagon(1, 0.3), relaxed("arkode:BOGACKI_SHAMPINE_4_2_3"), 10.0);
    const std::vector<double> expected{0.0, 2.5, 5.0, 7.5, 10.0};
    BOOST_TEST(kept.outputs == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_energy_is_kept_through_events) {
    if (!available) return;
    // x'' = -x^3, thrown back at x = -0.4: E = v^2/2 + x^4/4.
    std::vector<double> drifts;
    for (const bool relaxation : {true, false}) {
        const SundialsContext context;
        Ode ode;
        ode.rates = [](double, std::span<const double> y, std::span<double> y_dot) {
            y_dot[0] = y[1];
            y_dot[1] = -y[0] * y[0] * y[0];
        };
        ode.failure = [] { return std::string{}; };
        ode.entry_name = [](std::size_t k) { return std::to_string(k); };
        ode.absolute_tolerance = {1e-6, 1e-6};
        ode.energy = [](std::span<const double> y) {
            return 0.5 * y[1] * y[1] + 0.25 * y[0] * y[0] * y[0] * y[0];
        };
        ode.energy_gradient = [](double, std::span<const double> y, std::span<double> gradient) {
            gradient[0] = y[0] * y[0] * y[0];
            gradient[1] = y[1];
            return std::size_t{0};
        };
        Event bounce;
        bounce.name = "bounce";
        bounce.distance = [](double, std::span<const double> y) { return y[0] + 0.4; };
        bounce.apply = [](double, std::span<double> y) -> std::size_t {
            y[1] = -y[1];
            return 1;
        };
        ode.events.push_back(bounce);
        Vector y(2, context);
        y.span()[0] = 1.0;
        auto options = relaxed("arkode:VERNER_8_5_6");
        options.relaxation = relaxation;
        const auto integrator = make_integrator(options, ode, y, 0.0, context);
        drive(*integrator, {100.0, 100.0, 100.0}, {});
        BOOST_TEST(integrator->statistics().events > 10U);
        BOOST_TEST(integrator->t() == 100.0);
        drifts.push_back(std::abs(ode.energy(y.span()) / 0.25 - 1.0));
        BOOST_TEST_MESSAGE("events " << integrator->statistics().events << ", steps "
                                     << integrator->statistics().steps << ", rates "
                                     << integrator->statistics().rhs_evaluations << ", drift "
                                     << drifts.back());
    }
    BOOST_TEST(drifts[0] < 0.01 * drifts[1]);
    BOOST_TEST(drifts[0] < 1e-11);
}

BOOST_AUTO_TEST_CASE(what_no_rescaling_keeps_stops_the_run) {
    if (!available) return;
    const auto system = smooth_hexagon(1, 0.3);
    const auto energy = system->ode.energy;
    system->ode.energy = [&](std::span<const double> y) { return energy(y) + y[0]; };
    const SundialsContext context;
    Vector y = start_of(*system, context);
    const auto integrator =
        make_integrator(relaxed("arkode:VERNER_8_5_6"), system->ode, y, 0.0, context);
    BOOST_CHECK_EXCEPTION(integrator->step(1.0), GuardStop, [](const GuardStop& stop) {
        return std::string(stop.what()).starts_with("no step was found whose rescaling keeps");
    });
    BOOST_TEST(largest_difference(y.span(), system->y0) == 0.0);
    system->ode.energy = energy;
    integrator->reset(0.0);
    BOOST_TEST(integrator->step(1.0) > 0.0);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_rescaled_is_refused) {
    const auto says = [](const IntegratorOptions& options, const std::string& words) {
        const std::string reason = refusal([&] { options.validate(); });
        BOOST_TEST((reason.find(words) != std::string::npos), reason);
        BOOST_TEST(reason.starts_with("relaxation: "), reason);
    };
    const std::vector<std::string> others{"rk4", "leapfrog", "gsl:rk8pd", "cvode:adams"};
    const auto verner = relaxed("arkode:ARKODE_VERNER_8_5_6");
    if (!available) {
        const std::string words = "needs SUNDIALS 6.6 or later, this is " + sundials_version();
        says(verner, words);
        for (const std::string& method : others) says(relaxed(method), words);
        return;
    }
    for (const std::string& method : others)
        says(relaxed(method), method + " cannot rescale its steps");
    BOOST_TEST(refusal([&] { verner.validate(); }) == "accepted");
    auto fixed = verner;
    fixed.dt = 0.1;
    says(fixed, "cannot be rescaled");
    says(relaxed("arkode:DORMAND_PRINCE_7_4_5"), "negative weight");
    says(relaxed("arkode:KNOTH_WOLKE_3_3"), "cannot choose its steps");
    for (const IntegrationMethod& method : integration_methods())
        if (method.name.starts_with("arkode:") && method.order < 2)
            says(relaxed(method.name), "has order 1");
    const auto system = smooth_hexagon(1, 0.3);
    system->ode.energy = {};
    system->ode.no_energy = "friction takes it away";
    const SundialsContext context;
    Vector y = start_of(*system, context);
    BOOST_CHECK_EXCEPTION(make_integrator(verner, system->ode, y, 0.0, context), InputError,
                          [](const InputError& error) {
                              return std::string(error.what()).find("friction takes it away") !=
                                     std::string::npos;
                          });
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Fluids whose particles take the work of their own stress (Work::own): rates against loops over all pairs, sum
// m (e + v^2/2) kept to the last digits, every gas on its adiabat, friction that heats every particle, and no
// heat taken from a particle that has none. What the mean form and a form with the partner's stress do instead.
#include "support/fluid_oracle.hpp"
#include "support/random_fluid.hpp"
#include "support/refusal.hpp"
#include <spam/core/exact_sum.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/material/van_der_waals.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <functional>

using namespace spam;
using namespace spam::test;

namespace {

constexpr double range = 2.6;

template <int Dim>
constexpr int cells = Dim == 1   ? 30
                      : Dim == 2 ? 9
                                 : 5;

/// |d/dt sum m (e + v^2/2)| by the sum of the sizes of its parts.
template <int Dim>
double energy_residual(const FluidModel<Dim>& model, std::span<const double> y,
                       std::span<const double> y_dot) {
    const ConstState<Dim> state(model.layout(), y), rate(model.layout(), y_dot);
    ExactSum energy;
    double size = 0.0;
    for (Eigen::Index i = 0; i < state.energy().cols(); ++i) {
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        const double heat = m * rate.energy()(0, i),
                     power = m * state.velocity().col(i).dot(rate.velocity().col(i));
        energy += heat;
        energy += power;
        size += std::abs(heat) + std::abs(power);
    }
    return std::abs(energy) / size;
}

std::vector<Scheme> schemes() {
    std::vector<Scheme> all;
    for (const Density density : {Density::continuity, Density::summed})
        for (const auto transport : {Transport::plain, Transport::monaghan, Transport::average})
            for (const auto mean : {MeanDensityKind::arithmetic, MeanDensityKind::geometric})
                for (const double viscosity : {0.0, 1.0})
                    for (const Kernel kernel : {Kernel::lucy, Kernel::w4})
                        if (density == Density::continuity || transport == Transport::plain)
                            all.push_back({.density = density,
                                           .transport = transport,
                                           .mean_density = mean,
                                           .work = Work::own,
                                           .viscosity = viscosity,
                                           .kernel = kernel,
                                           .range = range});
    return all;
}

template <int Dim>
std::vector<Fluid> fluids() {
    const NewtonViscosity friction{0.2, 0.3};
    Fluid rubbing{GammaGas{1.4}, friction, FourierConduction{0.7}};
    rubbing.by_pairs = true;
    return {{GammaGas{1.4}},
            {IdealGas{Dim, 2.0}, friction},
            {VanDerWaals{0.5, 0.2, Dim}, friction, FourierConduction{0.7}},
            rubbing};
}

/// f(model, y) for every fluid, scheme and box that go together.
template <int Dim, class F>
void for_each_gas(const F& f) {
    for (const bool closed : {false, true})
        for (const Fluid& fluid : fluids<Dim>())
            for (const Scheme& scheme : schemes()) {
                const Box<Dim> box = closed ? periodic<Dim>(cells<Dim>) : Box<Dim>{};
                FluidModel<Dim> model(jittered_particles<Dim>(cells<Dim>, 21, 0.15, box), fluid,
                                      scheme, box);
                BOOST_TEST_CONTEXT(model.describe() << (closed ? ", closed" : ", open"))
                f(model, random_fluid(model, 22));
            }
}

template <int Dim>
void check_energy() {
    for_each_gas<Dim>([](FluidModel<Dim>& model, const std::vector<double>& y) {
        const auto y_dot = rates_of(model, y);
        BOOST_TEST_REQUIRE(model.failure().empty(), model.failure());
        BOOST_TEST(energy_residual<Dim>(model, y, y_dot) < 1e-13);
        const Scheme& scheme = model.scheme();
        if (scheme.viscosity > 0.0 || scheme.transport != Transport::plain ||
            model.fluid().by_pairs)
            return;
        BOOST_TEST(relative_difference(y_dot, fluid_rates(model, y)) < 1e-12);
        BOOST_TEST(relative_difference(y_dot, fluid_rates(model, y, FluidMutation::partners_work)) >
                   1e-3);
        BOOST_TEST(energy_residual<Dim>(
                       model, y, fluid_rates(model, y, FluidMutation::work_not_shared)) > 1e-4);
    });
}

/// The rates of energy of particles every third of which has none.
template <int Dim>
double least_rate_of_the_cold(
    const Fluid& fluid, const Scheme& scheme,
    const std::function<std::vector<double>(FluidModel<Dim>&, std::span<const double>)>& rates) {
    FluidModel<Dim> model(jittered_particles<Dim>(cells<Dim>, 31, 0.15), fluid, scheme);
    auto y = random_fluid(model, 32);
    const State<Dim> state(model.layout(), y);
    for (Eigen::Index i = 0; i < state.energy().cols(); i += 3) state.energy()(0, i) = 0.0;
    const auto y_dot = rates(model, y);
    const ConstState<Dim> rate(model.layout(), y_dot);
    double least = HUGE_VAL;
    for (Eigen::Index i = 0; i < state.energy().cols(); i += 3)
        least = std::min(least, rate.energy()(0, i));
    return least;
}

template <int Dim>
void check_cold_particles() {
    const auto computed = [](FluidModel<Dim>& model, std::span<const double> y) {
        const std::vector<double> all(y.begin(), y.end());
        auto y_dot = rates_of(model, all);
        BOOST_TEST_REQUIRE(model.failure().empty(), model.failure());
        return y_dot;
    };
    Fluid rubbing{GammaGas{1.4}, NewtonViscosity{0.2, 0.3}};
    rubbing.by_pairs = true;
    const Fluid gas{GammaGas{1.4}}, sticky{GammaGas{1.67}, NewtonViscosity{0.2, 0.3}};
    for (const Fluid& fluid : {gas, sticky, rubbing})
        for (Scheme scheme : schemes()) {
            BOOST_TEST_CONTEXT(fluid.describe() << ", " << scheme.describe()) {
                // Rounding of viscous stresses, which by themselves are far above it.
                BOOST_TEST(least_rate_of_the_cold<Dim>(fluid, scheme, computed) > -1e-13);
                scheme.work = Work::mean;
                if (!fluid.viscosity && scheme.viscosity == 0.0)
                    BOOST_TEST(least_rate_of_the_cold<Dim>(fluid, scheme, computed) < -1e-2);
            }
        }
    const auto wrong = [](FluidModel<Dim>& model, std::span<const double> y) {
        return fluid_rates(model, y, FluidMutation::partners_work);
    };
    BOOST_TEST(least_rate_of_the_cold<Dim>(gas, schemes().front(), wrong) < -1e-2);
}

std::string why_refused(const auto& matter, const Scheme& scheme) {
    return refusal([&] {
        ParticleModel<2> model(jittered_particles<2>(8, 31), {});
        model.add_term<SmoothParticles<2>>(matter, scheme);
    });
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { check_energy<1>(); }
BOOST_AUTO_TEST_CASE(in_the_plane) { check_energy<2>(); }
BOOST_AUTO_TEST_CASE(in_space) { check_energy<3>(); }

BOOST_AUTO_TEST_CASE(what_has_no_heat_loses_none) {
    check_cold_particles<1>();
    check_cold_particles<2>();
    check_cold_particles<3>();
}

/// de = (P/rho^2) drho, with the density that is integrated.
BOOST_AUTO_TEST_CASE(every_particle_stays_on_its_adiabat) {
    for (const Work work : {Work::own, Work::mean}) {
        FluidModel<2> model(jittered_particles<2>(10, 41), {GammaGas{1.4}},
                            {.work = work, .range = range});
        const auto y = random_fluid(model, 42), y_dot = rates_of(model, y);
        const ConstState<2> state(model.layout(), y), rate(model.layout(), y_dot);
        const auto P = model.pressure(y);
        double apart = 0.0, size = 0.0;
        for (Eigen::Index i = 0; i < rate.energy().cols(); ++i) {
            const double rho = state.density()(0, i);
            const double adiabatic =
                P[static_cast<std::size_t>(i)] / (rho * rho) * rate.density()(0, i);
            apart = std::max(apart, std::abs(rate.energy()(0, i) - adiabatic));
            size = std::max(size, std::abs(adiabatic));
        }
        if (work == Work::own)
            BOOST_TEST(apart < 1e-13 * size);
        else
            BOOST_TEST(apart > 1e-2 * size);
    }
}

BOOST_AUTO_TEST_CASE(what_it_means_nothing_for_is_refused) {
    const auto says = [](const std::string& text, const char* words) {
        return text.find(words) != std::string::npos;
    };
    const Scheme own{.work = Work::own, .range = range};
    BOOST_TEST(why_refused(Fluid{IdealGas{}}, own) == "accepted");
    BOOST_TEST(
        says(why_refused(Fluid{LucyGas{}}, own), "work: own is for laws with a temperature"));
    BOOST_TEST(says(why_refused(ElasticSolid{0.7, 0.4}, own), "work: own is for fluids"));
    Scheme balanced = own;
    balanced.angular_momentum = AngularMomentum::torque_pair;
    BOOST_TEST(says(why_refused(Fluid{IdealGas{}}, balanced), "work: own gives each particle"));
    // Of several fluids one with a temperature is enough.
    auto particles = jittered_particles<2>(8, 31);
    particles.material.assign(particles.size(), 0);
    particles.material.back() = 1;
    ParticleModel<2> both(std::move(particles), {});
    BOOST_CHECK_NO_THROW(
        both.add_term<SmoothParticles<2>>(std::vector<Fluid>{{LucyGas{}}, {IdealGas{}}}, own));
}

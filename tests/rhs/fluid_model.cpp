// SPDX-License-Identifier: GPL-3.0-or-later
// Fluids of smooth particles against loops over all pairs, with every law, weight function and mean;
// mass, momentum and energy kept to the last digits whatever the law; and what is refused or named.
#include "support/fluid_oracle.hpp"
#include "support/random_fluid.hpp"
#include "support/refusal.hpp"
#include <spam/core/exact_sum.hpp>
#include <spam/core/parallel.hpp>
#include <spam/material/cavitation.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/isentropic_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/material/van_der_waals.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

/// Every equation of state, and friction and conduction on where they can be.
std::vector<Fluid> all_fluids(int dim) {
    const NewtonViscosity friction{0.2, 0.3};
    const FourierConduction conduction{0.7};
    const IdealGas ideal{dim, 1.0};
    const VanDerWaals real{0.5, 0.2, dim};
    return {{LucyGas{}},
            {LucyGas{}, friction},
            {IsentropicGas{0.7, 1.1, 1.4}, friction},
            {EmbeddedAtom{1.2, 1.1}, friction},
            {Cavitating<EmbeddedAtom>{{1.2, 1.1}, 0.01}, friction},
            {ideal},
            {ideal, {}, conduction},
            {ideal, friction, conduction},
            {real, friction, conduction},
            {Cavitating<VanDerWaals>{real, 0.05}, friction, conduction}};
}

/// Rates against the oracle; rates of what is kept against the sums of their parts' sizes.
template <int Dim>
void check(const Fluid& fluid, const Scheme& scheme, int cells, const Box<Dim>& box) {
    FluidModel<Dim> model(jittered_particles<Dim>(cells, 21, 0.15, box), fluid, scheme, box);
    const auto y = random_fluid(model, 22);
    const auto y_dot = rates_of(model, y);
    BOOST_TEST(model.failure().empty());
    BOOST_TEST(relative_difference(y_dot, fluid_rates(model, y)) < 1e-12);

    const ConstState<Dim> state(model.layout(), y), rate(model.layout(), y_dot);
    ExactSum energy, size, momentum[Dim];
    double push = 0.0;
    for (Eigen::Index i = 0; i < state.energy().cols(); ++i) {
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        const double power = m * state.velocity().col(i).dot(rate.velocity().col(i));
        energy += m * rate.energy()(0, i);
        energy += power;
        size += std::abs(m * rate.energy()(0, i)) + std::abs(power);
        for (int a = 0; a < Dim; ++a) momentum[a] += m * rate.velocity()(a, i);
        push += m * rate.velocity().col(i).norm();
    }
    BOOST_TEST(std::abs(energy) < 1e-13 * size);
    for (const double p : momentum) BOOST_TEST(std::abs(p) < 1e-13 * push);
}

template <int Dim>
void check_all(int cells, double length) {
    for (const Fluid& fluid : all_fluids(Dim))
        for (const Density density : {Density::summed, Density::continuity})
            for (const bool closed : {false, true}) {
                const Box<Dim> box = closed ? periodic<Dim>(length) : Box<Dim>{};
                const auto mean = closed ? MeanDensityKind::geometric : MeanDensityKind::arithmetic;
                const Scheme scheme{
                    .density = density, .mean_density = mean, .kernel = Kernel::lucy, .range = 2.6};
                BOOST_TEST_CONTEXT(fluid.describe()
                                   << "; " << scheme.describe() << (closed ? ", closed" : ", open"))
                check<Dim>(fluid, scheme, cells, box);
            }
    for (const Kernel kernel : all_kernels()) {
        const Scheme scheme{.density = Density::summed, .kernel = kernel, .range = 2.6};
        BOOST_TEST_CONTEXT(scheme.describe()) {
            check<Dim>(all_fluids(Dim)[7], scheme, cells, {});
            check<Dim>(all_fluids(Dim)[0], scheme, cells, periodic<Dim>(length));
        }
    }
}

std::string why_refused(const Fluid& fluid, const Scheme& scheme, const Box<2>& box = {}) {
    return refusal(
        [&] { FluidModel<2>(jittered_particles<2>(8, 31, 0.1, box), fluid, scheme, box); });
}

bool says(const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) { check_all<1>(40, 40.0); }
BOOST_AUTO_TEST_CASE(in_the_plane) { check_all<2>(10, 10.0); }
BOOST_AUTO_TEST_CASE(in_space) { check_all<3>(6, 6.0); }

BOOST_AUTO_TEST_CASE(what_is_wrong_is_noticed) {
    const Fluid fluid = all_fluids(2)[7];
    FluidModel<2> model(jittered_particles<2>(10, 21), fluid,
                        {.density = Density::summed, .range = 2.6});
    const auto y = random_fluid(model, 22), y_dot = rates_of(model, y);
    BOOST_TEST(relative_difference(y_dot, fluid_rates(model, y)) < 1e-12);
    for (const auto mutation : {FluidMutation::printed_work, FluidMutation::work_not_shared,
                                FluidMutation::heat_of_one, FluidMutation::wrong_mass})
        BOOST_TEST(relative_difference(y_dot, fluid_rates(model, y, mutation)) > 1e-3);
}

BOOST_AUTO_TEST_CASE(the_rates_of_energies_show_wrong_laws) {
    // What the exactness above is worth: with the work not shared, or heat that only leaves, the sum is
    // not zero.
    FluidModel<2> model(jittered_particles<2>(10, 21), all_fluids(2)[7],
                        {.density = Density::summed, .range = 2.6});
    const auto y = random_fluid(model, 22);
    const ConstState<2> state(model.layout(), y);
    for (const auto mutation : {FluidMutation::printed_work, FluidMutation::work_not_shared,
                                FluidMutation::heat_of_one}) {
        const auto y_dot = fluid_rates(model, y, mutation);
        const ConstState<2> rate(model.layout(), y_dot);
        double energy = 0.0, size = 0.0;
        for (Eigen::Index i = 0; i < state.energy().cols(); ++i) {
            const double m = model.particles().mass[static_cast<std::size_t>(i)];
            const double power = m * state.velocity().col(i).dot(rate.velocity().col(i));
            energy += m * rate.energy()(0, i) + power;
            size += std::abs(m * rate.energy()(0, i)) + std::abs(power);
        }
        BOOST_TEST(std::abs(energy) > 1e-4 * size);
    }
}

BOOST_AUTO_TEST_CASE(no_bit_depends_on_threads) {
    const Box<2> box = periodic<2>(48.0);
    const auto particles = jittered_particles<2>(48, 51, 0.15, box);
    for (const Fluid& fluid : {all_fluids(2)[0], all_fluids(2)[8]}) {
        FluidModel<2> model(particles, fluid, {.density = Density::summed, .range = 3.0}, box);
        const auto y = random_fluid(model, 52);
        set_threads(1);
        const auto alone = rates_of(model, y);
        for (const int threads : {2, 3}) {
            set_threads(threads);
            BOOST_TEST((rates_of(model, y) == alone));
        }
        set_threads(1);
    }
}

BOOST_AUTO_TEST_CASE(the_gas_of_the_weight_function_moves_like_molecules) {
    // [HH01]: P/rho^2 is the same for all particles, so that forces are those of the pair potential
    // m^2 w, whatever the masses.
    const Box<2> box = periodic<2>(20.0);
    const auto particles = jittered_particles<2>(20, 61, 0.15, box);
    FluidModel<2> gas(particles, {LucyGas{}}, {.density = Density::summed, .range = 3.0}, box);
    PairPotentialModel<2> molecules(particles, 3.0, box);
    const auto y = random_fluid(gas, 62);
    std::vector<double> z(molecules.layout().size());
    const ConstState<2> from(gas.layout(), y);
    State<2>(molecules.layout(), z).position() = from.position();
    State<2>(molecules.layout(), z).velocity() = from.velocity();
    const auto y_dot = rates_of(gas, y), z_dot = rates_of(molecules, z);
    const auto a = ConstState<2>(gas.layout(), y_dot).velocity();
    const auto b = ConstState<2>(molecules.layout(), z_dot).velocity();
    BOOST_TEST((a - b).norm() < 1e-14 * b.norm());
}

BOOST_AUTO_TEST_CASE(the_density_that_is_integrated_is_the_one_that_is_summed) {
    FluidModel<2> model(jittered_particles<2>(10, 71), {LucyGas{}},
                        {.density = Density::continuity, .range = 2.6});
    FluidModel<2> sums(jittered_particles<2>(10, 71), {LucyGas{}},
                       {.density = Density::summed, .range = 2.6});
    const auto& x = model.particles().reference_position;
    const Points<2> v = Points<2>::Random(2, x.cols());
    const auto y = model.state(x, v);
    const auto y_dot = rates_of(model, y);
    const double h = 1e-5;
    const auto later = sums.density(sums.state(x + h * v, v));
    const auto earlier = sums.density(sums.state(x - h * v, v));
    const auto rho_dot = ConstState<2>(model.layout(), y_dot).density();
    for (std::size_t i = 0; i < later.size(); ++i)
        BOOST_TEST(std::abs((later[i] - earlier[i]) / (2.0 * h) -
                            rho_dot(0, static_cast<Eigen::Index>(i))) < 1e-8);
}

BOOST_AUTO_TEST_CASE(states_outside_the_law_name_the_particle) {
    const auto failure = [](const Fluid& fluid, const auto& spoil) {
        FluidModel<2> model(jittered_particles<2>(8, 31), fluid,
                            {.density = Density::summed, .range = 2.6});
        auto y = random_fluid(model, 32);
        BOOST_TEST(std::isfinite(rates_of(model, y).front()));
        spoil(State<2>(model.layout(), y));
        BOOST_TEST(std::isnan(rates_of(model, y).front()));
        const std::string name = "particle " + std::to_string(model.particles().id[17]) + " ";
        BOOST_TEST(says(model.failure(), name.c_str()), model.failure());
        return model.failure();
    };
    const auto cold = [](const State<2>& s) { s.energy()(0, 17) = -0.1; };
    BOOST_TEST(says(failure({IdealGas{}}, cold), "no temperature above zero"));
    BOOST_TEST(says(
        failure({VanDerWaals{0.5, 0.2, 2}}, [](const State<2>& s) { s.energy()(0, 17) = -3.0; }),
        "van der Waals"));
    FluidModel<2> dense(jittered_particles<2>(8, 31), {VanDerWaals{0.5, 3.0, 2}},
                        {.density = Density::summed, .range = 2.6});
    std::vector<double> y(dense.layout().size(), 1.0);
    State<2>(dense.layout(), y).position() = dense.particles().reference_position;
    rates_of(dense, y);
    BOOST_TEST(says(dense.failure(), "outside the law (van der Waals"), dense.failure());
    FluidModel<2> integrated(jittered_particles<2>(8, 31), {LucyGas{}},
                             {.density = Density::continuity, .range = 2.6});
    auto z = random_fluid(integrated, 33);
    State<2>(integrated.layout(), z).density()(0, 3) = -0.2;
    rates_of(integrated, z);
    BOOST_TEST(says(integrated.failure(), "density -0.2 of particle"), integrated.failure());
}

BOOST_AUTO_TEST_CASE(a_gas_may_be_as_cold_as_can_be) {
    for (const Fluid& fluid : {Fluid{IdealGas{}}, Fluid{VanDerWaals{0.5, 0.2, 2}}}) {
        FluidModel<2> model(jittered_particles<2>(8, 31), fluid,
                            {.density = Density::summed, .range = 2.6});
        const auto& x = model.particles().reference_position;
        auto y = model.state(x, Points<2>::Zero(2, x.cols()), 0.0);
        BOOST_TEST(std::isfinite(rates_of(model, y).front()), model.failure());
        BOOST_TEST(model.failure().empty(), model.failure());
    }
}

BOOST_AUTO_TEST_CASE(friction_alone_costs_the_angular_momentum) {
    const auto promise = [](const Fluid& fluid) {
        return FluidModel<2>(jittered_particles<2>(8, 31), fluid,
                             {.density = Density::summed, .range = 2.6})
            .promises()
            .angular_momentum;
    };
    BOOST_TEST((promise({IdealGas{}}) == Promise::integrator_error));
    BOOST_TEST((promise({IdealGas{}, {}, FourierConduction{0.7}}) == Promise::integrator_error));
    BOOST_TEST((promise({IdealGas{}, NewtonViscosity{0.2, 0.3}}) == Promise::not_kept));
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense_is_refused) {
    FluidModel<2> dense(jittered_particles<2>(8, 31), {VanDerWaals{0.5, 3.0, 2}},
                        {.density = Density::summed, .range = 2.6});
    const Points<2> x = dense.particles().reference_position;
    BOOST_TEST(says(refusal([&] { dense.state(x, Points<2>::Zero(2, x.cols()), 1.0); }),
                    "at the start are outside the law (van der Waals"));
    const Fluid gas{IdealGas{}};
    BOOST_TEST(why_refused(gas, {.range = 2.6}) == "accepted");
    BOOST_TEST(why_refused(gas, {.range = 9.0}, periodic<2>(8.0)) == "accepted");
    BOOST_TEST(says(why_refused(gas, {.density = Density::chain_rule}), "density: chain_rule"));
    BOOST_TEST(says(why_refused(gas, {.range = 0.9}), "range"));
    BOOST_TEST(says(why_refused(gas, {.range = 41.0}, periodic<2>(8.0)), "box: periodic length 8"));
    BOOST_TEST(says(why_refused({LucyGas{}, {}, FourierConduction{1.0}}, {}), "has none"));
    BOOST_TEST(why_refused({LucyGas{}, {}, FourierConduction{0.0}}, {}) == "accepted");
    BOOST_TEST(says(why_refused({IdealGas{}, NewtonViscosity{0.0, -1.0}}, {}), "shear viscosity"));
    BOOST_TEST(says(why_refused({IdealGas{}, NewtonViscosity{-2.0, 1.0}}, {}), "bulk viscosity"));
    BOOST_TEST(why_refused({IdealGas{}, NewtonViscosity{-1.0, 1.0}}, {}) == "accepted");
    BOOST_TEST(says(why_refused({IdealGas{}, {}, FourierConduction{-1.0}}, {}), "conductivity"));
    // All its forces are central: the torques that would be balanced are rounding errors.
    for (const auto law : {AngularMomentum::torque_pair, AngularMomentum::torque_particle}) {
        Scheme balanced{.transport = Transport::average, .angular_momentum = law, .viscosity = 1.0};
        BOOST_TEST(says(why_refused(gas, balanced), "has nothing"));
        BOOST_TEST(says(why_refused({IdealGas{}, NewtonViscosity{0.1, 0.0}}, balanced),
                        "has nothing"));  // bulk viscosity alone
        BOOST_TEST(why_refused({IdealGas{}, NewtonViscosity{0.0, 1.0}}, balanced) == "accepted");
        balanced.transport = Transport::monaghan;
        BOOST_TEST(why_refused(gas, balanced) == "accepted");
    }
}

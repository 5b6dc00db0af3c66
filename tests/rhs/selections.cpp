// SPDX-License-Identifier: GPL-3.0-or-later
// Terms among parts of the particles: each part moves as it would alone, to the last bit, and together they
// do what a further term among all of them says.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/friction.hpp>
#include <spam/external/gravity.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/ellipses.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cstring>

using namespace spam;
using namespace spam::test;

namespace {

constexpr std::size_t side = 9;
const Scheme viscous{.transport = Transport::monaghan,
                     .angular_momentum = AngularMomentum::torque_pair,
                     .viscosity = 0.5,
                     .closest_approach = 0.4,
                     .range = 2.6};

Particles<2> block(double at) {
    Points<2> x = triangular_block(side, side);
    x.row(0).array() += at;
    return make_particles<2>(x, 1.2);
}

/// A solid, a fluid on top of it that does not feel it, and springs at the end.
Particles<2> all_three() { return joined<2>({block(0.0), block(0.3), block(0.7)}); }

constexpr std::size_t n = side * side;
const auto solid = Material<2>(ElasticSolid::triangular_lattice());
const Fluid gas{IdealGas{2, 1.0}};

std::unique_ptr<ParticleModel<2>> together(const Scheme& of_solid = viscous) {
    auto model = std::make_unique<ParticleModel<2>>(all_three());
    model->add_term_among<SmoothParticles<2>>(0, n, solid, of_solid);
    model->add_term_among<SmoothParticles<2>>(n, n, gas, Scheme{.range = 2.6});
    model->add_term_among<Springs<2>>(2 * n, n, HarmonicSpring{});
    return model;
}

/// Every part alone, as a model of its own.
std::vector<std::unique_ptr<ParticleModel<2>>> alone() {
    std::vector<std::unique_ptr<ParticleModel<2>>> models;
    for (const double at : {0.0, 0.3, 0.7})
        models.push_back(std::make_unique<ParticleModel<2>>(block(at)));
    models[0]->add_term<SmoothParticles<2>>(solid, viscous);
    models[1]->add_term<SmoothParticles<2>>(gas, Scheme{.range = 2.6});
    models[2]->add_term<Springs<2>>(HarmonicSpring{});
    return models;
}

/// Fields of y that the part alone has.
void copy_part(const State<2>& all, std::size_t k, const State<2>& part) {
    for (const auto& b : part.layout().blocks())
        if (b.field.role() == Role::integrated && b.size == b.components * n)
            part.field(b.field) = all.part(k * n, n).field(b.field);
}

std::vector<double> random_start(ParticleModel<2>& model) {
    std::vector<double> y(model.layout().size(), 0.0);
    const State<2> state(model.layout(), y);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    state.position() = model.particles().reference_position;
    for (double& x : state.position().reshaped()) x += 0.02 * u(random);
    for (double& v : state.velocity().reshaped()) v = 0.1 * u(random);
    state.density().setConstant(1.2);
    for (double& s : state.stress().reshaped()) s = 0.01 * u(random);
    state.energy().setConstant(0.4);
    return y;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_part_moves_as_it_would_alone) {
    const auto model = together();
    auto y = random_start(*model);
    const auto rates = rates_of(*model, y);
    BOOST_TEST(model->failure() == "");
    const State<2> state(model->layout(), y);
    std::vector<double> found = rates;
    const State<2> of_all(model->layout(), found);
    auto parts = alone();
    double internal = 0.0;
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        std::vector<double> own(parts[k]->layout().size()), expected(own.size());
        copy_part(state, k, State<2>(parts[k]->layout(), own));
        const auto of_part = rates_of(*parts[k], own);
        copy_part(of_all, k, State<2>(parts[k]->layout(), expected));
        BOOST_TEST(std::memcmp(of_part.data(), expected.data(), sizeof(double) * own.size()) == 0);
        internal += parts[k]->internal_energy(own);
        pairs += parts[k]->pairs();
    }
    BOOST_TEST(model->internal_energy(y) == internal, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(model->pairs() == pairs);
    // Springs have neither density nor stress: what is not integrated stays as it is.
    BOOST_TEST(of_all.part(2 * n, n).density().cwiseAbs().maxCoeff() == 0.0);
    BOOST_TEST(of_all.part(n, 2 * n).stress().cwiseAbs().maxCoeff() == 0.0);
    BOOST_TEST(of_all.part(0, n).stress().cwiseAbs().maxCoeff() > 0.0);
}

BOOST_AUTO_TEST_CASE(a_further_term_acts_on_all_of_them) {
    const Scheme plain{.range = 2.6};  // with averaged velocities no potential may be added
    const auto apart = together(plain), meeting = together(plain);
    meeting->add_term<Core<2>>(CorePotential{.e_c = 0.3, .s = 0.9});
    const auto y = random_start(*apart);
    const auto without = rates_of(*apart, y), with = rates_of(*meeting, y);
    ParticleModel<2> core(all_three());
    core.add_term<Core<2>>(CorePotential{.e_c = 0.3, .s = 0.9});
    std::vector<double> x_v(core.layout().size());
    const ConstState<2> state(apart->layout(), y);
    State<2>(core.layout(), x_v).position() = state.position();
    State<2>(core.layout(), x_v).velocity() = state.velocity();
    const auto of_core = rates_of(core, x_v);
    const Points<2> sum = ConstState<2>(apart->layout(), without).velocity() +
                          ConstState<2>(core.layout(), of_core).velocity();
    const Points<2> found = ConstState<2>(meeting->layout(), with).velocity();
    BOOST_TEST((found - sum).norm() < 1e-13 * sum.norm());
    BOOST_TEST((found - ConstState<2>(apart->layout(), without).velocity()).norm() > 1e-3);
}

BOOST_AUTO_TEST_CASE(invariants_reflections_and_externals_of_parts) {
    for (const bool externals : {false, true}) {
        const auto model = together();
        if (externals) {
            model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.01)));
            model->add(std::make_unique<Friction<2>>(0.05, FrictionOf::all_motion));
        }
        const auto y0 = random_start(*model);
        IntegratorOptions options;
        options.dt = 0.02;
        Motion<2> motion(*model, y0, options);
        const auto before = measure_invariants<2>(*model, motion.y());
        motion.advance_to(2.0);
        const auto after = measure_invariants<2>(*model, motion.y());
        BOOST_TEST(model->events().size() == 1u);  // of the solid alone
        BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-11);
        BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) <
                   2e-4 * before.energy);
    }
}

BOOST_AUTO_TEST_CASE(what_does_not_go_together_and_what_does) {
    ParticleModel<2> model(all_three());
    model.add_term_among<SmoothParticles<2>>(0, 2 * n, solid, viscous);
    // The same fields of the same particles, and a potential beside averaged velocities: refused.
    BOOST_CHECK_THROW((model.add_term_among<SmoothParticles<2>>(n, n, gas, Scheme{.range = 2.6})),
                      InputError);
    BOOST_CHECK_THROW((model.add_term_among<Springs<2>>(n, 2 * n, HarmonicSpring{})), InputError);
    BOOST_CHECK_NO_THROW((model.add_term_among<Springs<2>>(2 * n, n, HarmonicSpring{})));
    for (const auto& [first, count] :
         {std::pair<std::size_t, std::size_t>{0, 0}, {3 * n, 1}, {1, 3 * n}, {std::size_t(-1), 2}})
        BOOST_CHECK_THROW((model.add_term_among<Springs<2>>(first, count, HarmonicSpring{})),
                          InputError);
}

BOOST_AUTO_TEST_CASE(the_start_of_a_fluid_is_that_of_a_whole_model) {
    const auto particles = all_three();
    const auto& x = particles.reference_position;
    const auto v = Points<2>(Points<2>::Zero(2, x.cols()));
    ParticleModel<2> model(particles), by_density(particles), of_ellipses(particles);
    auto& gases = model.add_term_among<SmoothParticles<2>>(n, n, gas, Scheme{.range = 2.6});
    auto& ranges = by_density.add_term_among<OwnRanges<2>>(n, n, gas, VariableRangeScheme{});
    auto& ellipses = of_ellipses.add_term_among<Ellipses<2>>(n, n, gas, EllipseScheme{});
    for (const std::string& said :
         {refusal([&] { gases.start(x, v, 1.0); }), refusal([&] { ranges.start(x, v, 1.0); }),
          refusal([&] { ellipses.start(x, v, 1.0); })})
        BOOST_TEST((said.starts_with("start: '") &&
                    said.find("some of the particles") != std::string::npos),
                   said);
    FluidModel<2> all(particles, gas, Scheme{.range = 2.6});
    BOOST_TEST(refusal([&] { all.state(x, v.leftCols(5)); }) ==
               "start: there are 243 positions and 5 velocities of 243 particles");
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Walls by images: mirrors are half of a symmetric periodic box, whatever the formulation; gas between them
// keeps its energy, and what walls give closes the accounts of every other.
#include "support/every_potential.hpp"
#include "support/mirrored.hpp"
#include "support/refusal.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/gravity.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

const Fluid gas{IdealGas{}}, water{IdealGas{}, NewtonViscosity{0.3, 0.1}, FourierConduction{0.4}};

bool says(const std::string& text, std::string_view what) {
    return text.find(what) != std::string::npos;
}

/// Warm gas between walls after some time: what has changed of energy and momentum, accounts taken off.
template <int Dim>
struct Outcome {
    double energy, momentum;
    std::size_t reflections;
    bool inside;
};
template <int Dim>
Outcome<Dim> run(const Fluid& fluid, const Box<Dim>& box, std::optional<double> dt, double t_end,
                 const std::string& method = "rk4") {
    FluidModel<Dim> model(jittered<Dim>(cells, 11), fluid,
                          {.density = Density::continuity, .range = 2.5}, box);
    Points<Dim> v(Dim, model.particles().reference_position.cols());
    std::mt19937_64 random(12);
    std::normal_distribution<double> g(0.0, 0.7);
    for (auto& c : v.reshaped()) c = g(random);
    const auto y0 = model.state(model.particles().reference_position, v, 1.0);
    Motion<Dim> motion(model, y0, {.method = method, .dt = dt, .rtol = 1e-10, .atol = 1e-12});
    const auto before = measure_invariants<Dim>(model, motion.y());
    motion.advance_to(t_end);
    const auto after = measure_invariants<Dim>(model, motion.y());
    const auto x = ConstState<Dim>(model.layout(), motion.y()).position();
    return {std::abs(after.energy_balance() - before.energy_balance()) / before.energy,
            (after.momentum_balance() - before.momentum_balance()).norm(), model.reflections(),
            x.minCoeff() > -0.1 && x.maxCoeff() < cells + 0.1};
}

}  // namespace

BOOST_AUTO_TEST_CASE(mirrors_are_half_of_a_symmetric_whole) {
    for (const auto density : {Density::continuity, Density::summed, Density::chain_rule})
        for (const auto transport : {Transport::plain, Transport::average, Transport::monaghan})
            for (const double viscosity : {0.0, 0.3}) {
                if (density == Density::chain_rule && transport == Transport::plain) continue;
                const Scheme scheme{.density = density,
                                    .transport = transport,
                                    .viscosity = viscosity,
                                    .range = 2.7};
                const Build<2> solid = [&](Particles<2> particles, const Box<2>& box) {
                    return std::make_unique<SmoothParticleModel<2>>(
                        std::move(particles), ElasticSolid{0.7, 0.4}, scheme, box);
                };
                BOOST_TEST(against_symmetric_whole<2>(solid) < 1e-13, scheme.describe());
                if (density != Density::continuity) continue;
                Fluid rubbing = water;
                rubbing.by_pairs = true;
                rubbing.viscosity = NewtonViscosity{0.1, 0.3};
                for (const Fluid& fluid : {gas, water, rubbing}) {
                    const Build<2> flow = [&](Particles<2> particles, const Box<2>& box) {
                        return std::make_unique<FluidModel<2>>(std::move(particles), fluid, scheme,
                                                               box);
                    };
                    BOOST_TEST(against_symmetric_whole<2>(flow) < 1e-13, scheme.describe());
                }
            }
    for (const auto density : {Density::continuity, Density::summed})
        for (const bool by_pairs : {false, true}) {
            Fluid cold{EmbeddedAtom{}, NewtonViscosity{0.1, 0.3}};
            cold.by_pairs = by_pairs;
            const Scheme scheme{.density = density, .transport = Transport::shifting, .range = 2.7};
            const Build<2> shifted = [&](Particles<2> particles, const Box<2>& box) {
                return std::make_unique<FluidModel<2>>(std::move(particles), cold, scheme, box);
            };
            BOOST_TEST(against_symmetric_whole<2>(shifted) < 1e-13, scheme.describe());
        }
    const DensityPotentials everything = every_potential();
    const Build<2> of_density = [&](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<DensityPotentialModel<2>>(std::move(particles), everything, box);
    };
    BOOST_TEST(against_symmetric_whole<2>(of_density) < 1e-13);
    const Build<3> lucy = [](Particles<3> particles, const Box<3>& box) {
        return std::make_unique<PairPotentialModel<3>>(std::move(particles), 2.9, box);
    };
    BOOST_TEST(against_symmetric_whole<3>(lucy) < 1e-13);
    const Build<3> space = [](Particles<3> particles, const Box<3>& box) {
        return std::make_unique<FluidModel<3>>(
            std::move(particles), water, Scheme{.density = Density::continuity, .range = 2.2}, box);
    };
    BOOST_TEST(against_symmetric_whole<3>(space) < 1e-13);
    const Build<2> own = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<VariableRangeModel<2>>(std::move(particles), gas,
                                                       VariableRangeScheme{.range = 2.2}, box);
    };
    BOOST_TEST(against_symmetric_whole<2>(own) < 1e-13);
}

// A square and a cube of gas: the energy by itself, the momentum with what the mirrors gave.
BOOST_AUTO_TEST_CASE(gas_between_mirrors_keeps_its_energy) {
    const auto coarse = run<2>(gas, mirrors<2>(cells), 0.04, 12.0);
    const auto fine = run<2>(gas, mirrors<2>(cells), 0.02, 12.0);
    BOOST_TEST(coarse.reflections > 20U);
    BOOST_TEST((coarse.inside && fine.inside));
    BOOST_TEST(coarse.energy < 1e-5);
    BOOST_TEST(fine.energy < coarse.energy / 8.0);
    BOOST_TEST(fine.momentum < 1e-10);
    const auto space = run<3>(gas, mirrors<3>(cells), 0.04, 4.0);
    BOOST_TEST(space.reflections > 20U);
    BOOST_TEST(space.energy < 1e-5);
    BOOST_TEST(run<3>(gas, mirrors<3>(cells), 0.02, 4.0).energy < space.energy / 8.0);
    BOOST_TEST(space.momentum < 1e-10);
    const auto adaptive = run<2>(gas, mirrors<2>(cells), {}, 12.0, "arkode:DORMAND_PRINCE_7_4_5");
    BOOST_TEST(adaptive.energy < 1e-7);
    BOOST_TEST(adaptive.reflections > 20U);
}

// Walls that rub, move and heat: friction and heat that pass them are in the account.
BOOST_AUTO_TEST_CASE(accounts_of_walls_close) {
    Box<2> box = mirrors<2>(cells, WallKind::no_slip);
    box.set_wall(1, false, {WallKind::no_slip, 0.0, {0.0, 0.0}, 1.5});
    box.set_wall(1, true, {WallKind::no_slip, double(cells), {0.3, 0.0}, 0.5});
    const auto coarse = run<2>(water, box, 0.04, 6.0), fine = run<2>(water, box, 0.02, 6.0);
    BOOST_TEST(coarse.energy < 1e-5);
    BOOST_TEST(fine.energy < coarse.energy / 8.0);
    BOOST_TEST(fine.momentum < 1e-10);
    BOOST_TEST(fine.inside);
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto walled = [](auto change) {
        return refusal([&] {
            Box<2> box = mirrors<2>(cells);
            change(box);
        });
    };
    BOOST_TEST(says(walled([](auto& b) {
                        b.set_wall(0, true, {WallKind::mirror, -1.0});
                    }),
                    "the lower one across direction x at 0 must lie below the upper one at -1"));
    BOOST_TEST(says(walled([](auto& b) {
                        b.set_wall(1, true, {WallKind::no_slip, 6.0, {0.0, 0.0}, -0.5});
                    }),
                    "temperature -0.5 across direction y must be above 0"));
    BOOST_TEST(says(walled([](auto& b) {
                        b.set_wall(0, true, {WallKind::mirror, 6.0, {0, 1}});
                    }),
                    "only no-slip walls can move"));
    BOOST_TEST(says(walled([](auto& b) {
                        b.set_wall(0, true, {WallKind::no_slip, 6.0, {1, 0}});
                    }),
                    "only no-slip walls can move"));
    BOOST_TEST(says(walled([](auto&) {
                        Box<2>({4.0, 0.0}).set_wall(0, true, {});
                    }),
                    "is periodic"));
    const auto refused = [](auto make) { return refusal(make); };
    const auto particles = jittered<2>(cells, 1);
    const Scheme far{.density = Density::continuity, .range = 6.5};
    BOOST_TEST(says(refused([&] { FluidModel<2>(particles, gas, far, mirrors<2>(cells)); }),
                    "images of images would have no end"));
    Box<2> narrow;
    narrow.set_wall(1, true, {WallKind::mirror, 3.0});
    BOOST_TEST(says(refused([&] { FluidModel<2>(particles, gas, {.range = 2.5}, narrow); }),
                    "is beyond the mirror wall at 3; move the body or the wall"));
    Scheme balanced{.angular_momentum = AngularMomentum::torque_pair, .range = 2.5};
    BOOST_TEST(says(
        refused([&] {
            SmoothParticleModel<2>(particles, ElasticSolid{0.7, 0.4}, balanced, mirrors<2>(cells));
        }),
        "walls give angular momentum"));
    Scheme near{.closest_approach = 0.4, .range = 2.5};
    BOOST_TEST(
        says(refused([&] {
                 SmoothParticleModel<2>(particles, ElasticSolid{0.7, 0.4}, near, mirrors<2>(cells));
             }),
             "closest approach"));
    BOOST_TEST(says(refused([&] {
                        PairPotentialModel<2>(particles, 2.5, mirrors<2>(cells, WallKind::no_slip));
                    }),
                    "neither the velocity nor the temperature of a wall"));
    BOOST_TEST(says(refused([&] {
                        BondedModel<2>(particles, HarmonicSpring{},
                                       mirrors<2>(cells, WallKind::no_slip));
                    }),
                    "use a mirror"));
    auto at_the_wall = particles;
    at_the_wall.reference_position(0, 3) = 0.0;
    BOOST_TEST(
        says(refused([&] { BondedModel<2>(at_the_wall, HarmonicSpring{}, mirrors<2>(cells)); }),
             "where another one or its own image is"));
    BOOST_TEST(says(refused([&] {
                        Box<2> warm = mirrors<2>(cells);
                        warm.set_wall(1, true, {WallKind::mirror, double(cells), {0, 0}, 1.5});
                        FluidModel<2>(particles, gas, {.range = 2.5}, warm);
                    }),
                    "top: nothing here conducts heat"));
}

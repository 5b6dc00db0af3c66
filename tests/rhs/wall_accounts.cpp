// SPDX-License-Identifier: GPL-3.0-or-later
// Impulse, work and heat of each wall by itself: together what all give, alone what the wall gives where it is
// alone, and for a pair potential the sum over all pairs with an image. Whatever the formulation.
#include "support/every_potential.hpp"
#include "support/random_state.hpp"
#include <spam/core/parallel.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/wall_images.hpp>
#include <spam/external/gravity.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

#include <functional>

using namespace spam;
using namespace spam::test;

namespace {

constexpr int cells = 9;
constexpr double range = 2.4;

Particles<2> particles() {
    auto all = jittered_particles<2>(cells, 7, 0.1);
    all.reference_position.colwise() +=
        Point<2>(0.3, 0.3) - Point<2>(all.reference_position.rowwise().minCoeff());
    return all;
}

/// Sides one by one: left, right, bottom, top.
using Walls = std::array<std::optional<Wall<2>>, 4>;

Box<2> room(Walls walls) {
    const Point<2> high = particles().reference_position.rowwise().maxCoeff().array() + 0.3;
    Box<2> box;
    for (int side = 0; side < 4; ++side) {
        auto& wall = walls[static_cast<std::size_t>(side)];
        if (!wall) continue;
        if (side % 2 == 1) wall->at = high[side / 2];
        box.set_wall(side / 2, side % 2 == 1, *wall);
    }
    return box;
}

using Build = std::function<std::unique_ptr<ParticleModel<2>>(const Box<2>&)>;

/// Rates of the accounts of the same state between whichever walls.
struct Accounts {
    struct Of {
        Point<2> impulse = Point<2>::Zero();
        double work = 0.0, heat = 0.0;
    };
    Of all;
    std::array<Of, 4> side;
};
Accounts accounts_of(const Build& build, const Box<2>& box) {
    const auto model = build(box), open = build({});
    const auto values = random_state(*open, 9);
    const ConstState<2> state(open->layout(), values);
    std::vector<double> y(model->layout().size(), 0.0);
    const State<2> here(model->layout(), y);
    for (const auto& block : open->layout().blocks())
        here.field(block.field) = state.field(block.field);
    if (here.has(Field::energy))
        for (double& e : here.energy().reshaped()) e = std::abs(e) + 0.5;
    const auto rates = rates_of(*model, y);
    BOOST_TEST_REQUIRE(model->failure().empty(), model->failure());
    const ConstState<2> rate(model->layout(), rates);
    const auto number = [&](Field field) {
        return rate.has(field) ? rate.field(field)(0, 0) : 0.0;
    };
    const auto vector = [&](Field field) {
        return rate.has(field) ? Point<2>(rate.field(field)) : Point<2>(0.0, 0.0);
    };
    Accounts found{{vector(Field::impulse), number(Field::work), number(Field::heat)}, {}};
    for (int side = 0; side < 4; ++side) {
        const int a = side / 2;
        const bool upper = side % 2 == 1;
        found.side[static_cast<std::size_t>(side)] = {vector(Field::wall_impulse(a, upper)),
                                                      number(Field::wall_work(a, upper)),
                                                      number(Field::wall_heat(a, upper))};
    }
    return found;
}

const Wall<2> mirror{WallKind::mirror}, warm{WallKind::no_slip, 0.0, Point<2>::Zero(), 1.4},
    moving{WallKind::no_slip, 0.0, {0.3, 0.0}, 0.8};

/// Where nothing conducts heat walls have no temperature.
Wall<2> insulated(Wall<2> wall) {
    wall.temperature.reset();
    return wall;
}

template <class Model, class... Arguments>
Build built(Arguments... arguments) {
    return
        [=](const Box<2>& box) { return std::make_unique<Model>(particles(), arguments..., box); };
}

struct Law {
    const char* name;
    Build build;
    bool only_mirrors, conducts;

    Wall<2> lower() const { return only_mirrors ? mirror : conducts ? warm : insulated(warm); }
    Wall<2> upper() const { return only_mirrors ? mirror : conducts ? moving : insulated(moving); }
};
std::vector<Law> laws() {
    const Scheme scheme{.density = Density::continuity, .range = range},
        summed{.density = Density::summed, .transport = Transport::monaghan, .range = range};
    Fluid water{IdealGas{}, NewtonViscosity{0.1, 0.3}, FourierConduction{0.4}};
    Fluid rubbing = water;
    rubbing.by_pairs = true;
    const Fluid inviscid{IdealGas{}};
    Scheme viscous = scheme, own_by_pairs = scheme;
    viscous.viscosity = 1.0;
    own_by_pairs.work = Work::own;
    Scheme own = viscous;
    own.work = Work::own;
    auto potentials = every_potential();
    potentials.range = range;
    return {{"gradients", built<FluidModel<2>>(water, viscous), false, true},
            {"own work", built<FluidModel<2>>(inviscid, own), true, false},
            {"own work of friction", built<FluidModel<2>>(water, own), false, true},
            {"own work, pairs", built<FluidModel<2>>(rubbing, own_by_pairs), false, true},
            {"pairs", built<FluidModel<2>>(rubbing, scheme), false, true},
            {"solid", built<SmoothParticleModel<2>>(ElasticSolid{0.7, 0.4}, summed), false, false},
            {"own ranges",
             built<VariableRangeModel<2>>(Fluid{IdealGas{}}, VariableRangeScheme{.range = 2.0}),
             false, false},
            {"Lucy", built<PairPotentialModel<2>>(range), true, false},
            {"densities", built<DensityPotentialModel<2>>(potentials), true, false}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(all_walls_together_give_what_is_given) {
    for (const Law& law : laws()) BOOST_TEST_CONTEXT(law.name) {
            const bool mirrors = law.only_mirrors;
            const Accounts found =
                accounts_of(law.build, room({mirror, law.lower(), law.lower(), law.upper()}));
            Accounts::Of sum;
            double size = 0.0;
            for (const auto& one : found.side) {
                sum.impulse += one.impulse;
                sum.work += one.work;
                sum.heat += one.heat;
                size += one.impulse.norm() + std::abs(one.heat);
                BOOST_TEST(one.impulse.norm() > 1e-2);
            }
            BOOST_TEST((sum.impulse - found.all.impulse).norm() < 1e-12 * size);
            BOOST_TEST(std::abs(sum.work - found.all.work) < 1e-12 * size);
            BOOST_TEST(std::abs(sum.heat - found.all.heat) < 1e-12 * size);
            if (!mirrors) BOOST_TEST(std::abs(found.side[3].work) > 1e-3);
        }
}

/// Walls that face each other are farther apart than particles see: each gives as if it were alone.
BOOST_AUTO_TEST_CASE(a_wall_gives_what_it_gives_alone) {
    for (const Law& law : laws()) BOOST_TEST_CONTEXT(law.name) {
            const Wall<2> lower = law.lower(), upper = law.upper();
            const Accounts both = accounts_of(law.build,
                                              room({std::nullopt, std::nullopt, lower, upper})),
                           alone = accounts_of(
                               law.build, room({std::nullopt, std::nullopt, std::nullopt, upper}));
            const double most = 1e-12 * (both.side[3].impulse.norm() + std::abs(both.side[3].heat) +
                                         both.side[2].impulse.norm());
            BOOST_TEST((both.side[3].impulse - alone.all.impulse).norm() < most);
            BOOST_TEST(std::abs(both.side[3].work - alone.all.work) < most);
            BOOST_TEST(std::abs(both.side[3].heat - alone.all.heat) < most);
            // Of a mirror the force across it, and nothing along it.
            if (law.only_mirrors) BOOST_TEST(std::abs(both.side[2].impulse.x()) < most);
        }
}

/// Every pair of a particle and an image, by hand; corners belong to the walls across y.
BOOST_AUTO_TEST_CASE(forces_of_a_pair_potential_are_those_of_all_pairs) {
    const Box<2> box = room({mirror, mirror, mirror, mirror});
    const Accounts found = accounts_of(built<PairPotentialModel<2>>(range), box);
    const auto all = particles();
    const Points<2>& x = all.reference_position;
    const auto images = images_behind_walls<2>(box, range, x, Points<2>::Zero(2, x.cols()));
    const Lucy<2> w(range);
    std::array<Point<2>, 4> expected;
    expected.fill(Point<2>::Zero());
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        for (Eigen::Index k = 0; k < images.count(); ++k) {
            const Point<2> apart = x.col(i) - images.position.col(k);
            if (apart.norm() >= range) continue;
            const auto j = images.owner[static_cast<std::size_t>(k)];
            int side = 0;
            for (int s = 0; s < 4; ++s)
                if (s % 2 == 1 ? images.position(s / 2, k) > box.wall(s / 2, true).at
                               : images.position(s / 2, k) < box.wall(s / 2, false).at)
                    side = s;
            expected[static_cast<std::size_t>(side)] += all.mass[static_cast<std::size_t>(i)] *
                                                        all.mass[static_cast<std::size_t>(j)] *
                                                        w.minus_slope_over_r(apart.norm()) * apart;
        }
    for (std::size_t side = 0; side < 4; ++side)
        BOOST_TEST((found.side[side].impulse - expected[side]).norm() <
                   1e-12 * expected[side].norm());
}

/// Over a run: reflections, lists of many ages, gravity. What the walls have given, wall by wall, is what has
/// come to the particles.
BOOST_AUTO_TEST_CASE(walls_add_up_over_a_run) {
    const auto run = [](const Build& build, bool falls, int threads) {
        set_threads(threads);
        const auto model = build(room({mirror, mirror, mirror, mirror}));
        const double g = falls ? 0.05 : 0.0;
        if (falls) model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -g)));
        std::vector<double> y(model->layout().size(), 0.0);
        const State<2> state(model->layout(), y);
        const auto values = random_state(*build({}), 3);
        state.position() = model->particles().reference_position;
        state.velocity() = 0.5 * ConstState<2>(build({})->layout(), values).velocity();
        if (state.has(Field::density)) state.density().setConstant(1.1);
        if (state.has(Field::energy)) state.energy().setConstant(0.5);
        const auto before = measure_invariants<2>(*model, y);
        Motion<2> motion(*model, y, {.method = "rk4", .dt = 0.05});
        motion.advance_to(10.0);
        set_threads(1);
        const auto after = measure_invariants<2>(*model, motion.y());
        Point<2> sum = Point<2>::Zero();
        for (int a = 0; a < 2; ++a)
            for (const bool upper : {false, true})
                sum += motion.state().field(Field::wall_impulse(a, upper));
        sum.y() -= before.mass * g * 10.0;
        BOOST_TEST(model->reflections() > 2U);
        BOOST_TEST((sum - (after.momentum - before.momentum)).norm() < 1e-9 * before.mass);
        return std::vector<double>(motion.y().begin(), motion.y().end());
    };
    for (const Law& law : laws()) {
        if (law.name != std::string("Lucy") && law.name != std::string("pairs")) continue;
        for (const bool falls : {false, true}) {
            const auto once = run(law.build, falls, 1);
            BOOST_TEST((once == run(law.build, falls, 2)));
        }
    }
}

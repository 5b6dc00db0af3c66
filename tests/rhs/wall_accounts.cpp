// SPDX-License-Identifier: GPL-3.0-or-later
// Impulse, work and heat of each wall by itself: together what all give, alone what the wall gives where it is
// alone, and for a pair potential the sum over all pairs with an image. Whatever the formulation.
#include "support/every_potential.hpp"
#include "support/plane_and_space.hpp"
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

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <functional>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
constexpr int cells = Dim == 2 ? 9 : 5;
constexpr double range = 2.4;

template <int Dim>
Particles<Dim> particles() {
    auto all = jittered_particles<Dim>(cells<Dim>, 7, 0.1);
    all.reference_position.colwise() +=
        Point<Dim>(0.3 - all.reference_position.rowwise().minCoeff().array());
    return all;
}

/// Sides one by one: left, right, bottom, top, front, back.
template <int Dim>
using Walls = std::array<std::optional<Wall<Dim>>, 2 * Dim>;

template <int Dim>
Box<Dim> room(Walls<Dim> walls) {
    const Point<Dim> high = particles<Dim>().reference_position.rowwise().maxCoeff().array() + 0.3;
    Box<Dim> box;
    for (int side = 0; side < 2 * Dim; ++side) {
        auto& wall = walls[static_cast<std::size_t>(side)];
        if (!wall) continue;
        if (side % 2 == 1) wall->at = high[side / 2];
        box.set_wall(side / 2, side % 2 == 1, *wall);
    }
    return box;
}

template <int Dim>
using Build = std::function<std::unique_ptr<ParticleModel<Dim>>(const Box<Dim>&)>;

/// Rates of the accounts of the same state between whichever walls.
template <int Dim>
struct Accounts {
    struct Of {
        Point<Dim> impulse = Point<Dim>::Zero();
        double work = 0.0, heat = 0.0;
    };
    Of all;
    std::array<Of, 2 * Dim> side;
    Eigen::VectorXd torque;
    double turning = 0.0;  ///< of sum m x cross a that in the plane of x and y, whatever gives it
};
template <int Dim>
Accounts<Dim> accounts_of(const Build<Dim>& build, const Box<Dim>& box) {
    set_threads(1);  // of few particles two wait for each other
    const auto model = build(box), open = build({});
    const auto values = random_state(*open, 9);
    const ConstState<Dim> state(open->layout(), values);
    std::vector<double> y(model->layout().size(), 0.0);
    const State<Dim> here(model->layout(), y);
    for (const auto& block : open->layout().blocks())
        here.field(block.field) = state.field(block.field);
    if (here.has(Field::energy))
        for (double& e : here.energy().reshaped()) e = std::abs(e) + 0.5;
    const auto rates = rates_of(*model, y);
    BOOST_TEST_REQUIRE(model->failure().empty(), model->failure());
    const ConstState<Dim> rate(model->layout(), rates);
    const auto number = [&](Field field) {
        return rate.has(field) ? rate.field(field)(0, 0) : 0.0;
    };
    const auto vector = [&](Field field) {
        return rate.has(field) ? Point<Dim>(rate.field(field)) : Point<Dim>(Point<Dim>::Zero());
    };
    Accounts<Dim> found{};
    found.all = {vector(Field::impulse), number(Field::work), number(Field::heat)};
    found.torque = rate.field(Field::angular_impulse);
    const auto x = here.position();
    const auto dv = rate.velocity();
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        found.turning += model->particles().mass[static_cast<std::size_t>(i)] *
                         (x(0, i) * dv(1, i) - x(1, i) * dv(0, i));
    for (int side = 0; side < 2 * Dim; ++side) {
        const int a = side / 2;
        const bool upper = side % 2 == 1;
        found.side[static_cast<std::size_t>(side)] = {vector(Field::wall_impulse(a, upper)),
                                                      number(Field::wall_work(a, upper)),
                                                      number(Field::wall_heat(a, upper))};
    }
    return found;
}

template <int Dim>
const Wall<Dim> mirror{.kind = WallKind::mirror};
template <int Dim>
const Wall<Dim> warm{.kind = WallKind::no_slip, .temperature = 1.4};
template <int Dim>
const Wall<Dim> moving{
    .kind = WallKind::no_slip, .velocity = 0.3 * Point<Dim>::Unit(0), .temperature = 0.8};

/// Where nothing conducts heat walls have no temperature.
template <int Dim>
Wall<Dim> insulated(Wall<Dim> wall) {
    wall.temperature.reset();
    return wall;
}

template <int Dim, template <int> class Model, class... Arguments>
Build<Dim> built(Arguments... arguments) {
    return [=](const Box<Dim>& box) {
        return std::make_unique<Model<Dim>>(particles<Dim>(), arguments..., box);
    };
}

template <int Dim>
struct Law {
    const char* name;
    Build<Dim> build;
    bool only_mirrors, conducts;

    Wall<Dim> lower() const {
        return only_mirrors ? mirror<Dim> : conducts ? warm<Dim> : insulated(warm<Dim>);
    }
    Wall<Dim> upper() const {
        return only_mirrors ? mirror<Dim> : conducts ? moving<Dim> : insulated(moving<Dim>);
    }
};
template <int Dim>
std::vector<Law<Dim>> laws() {
    const Scheme scheme{.density = Density::continuity, .range = range},
        summed{.density = Density::summed, .transport = Transport::monaghan, .range = range};
    Fluid water{IdealGas{Dim}, NewtonViscosity{0.1, 0.3}, FourierConduction{0.4}};
    Fluid rubbing = water;
    rubbing.by_pairs = true;
    const Fluid inviscid{IdealGas{Dim}};
    Scheme viscous = scheme, own_by_pairs = scheme;
    viscous.viscosity = 1.0;
    own_by_pairs.work = Work::own;
    Scheme own = viscous;
    own.work = Work::own;
    auto potentials = every_potential();
    potentials.range = range;
    return {
        {"gradients", built<Dim, FluidModel>(water, viscous), false, true},
        {"own work", built<Dim, FluidModel>(inviscid, own), true, false},
        {"own work of friction", built<Dim, FluidModel>(water, own), false, true},
        {"own work, pairs", built<Dim, FluidModel>(rubbing, own_by_pairs), false, true},
        {"pairs", built<Dim, FluidModel>(rubbing, scheme), false, true},
        {"pairs and artificial viscosity", built<Dim, FluidModel>(rubbing, viscous), false, true},
        {"solid", built<Dim, SmoothParticleModel>(ElasticSolid{0.7, 0.4}, summed), false, false},
        {"own ranges",
         built<Dim, VariableRangeModel>(Fluid{IdealGas{Dim}}, VariableRangeScheme{.range = 2.0}),
         false, false},
        {"Lucy", built<Dim, PairPotentialModel>(range), true, false},
        {"densities", built<Dim, DensityPotentialModel>(potentials), true, false}};
}

template <int Dim>
Box<Dim> mirrors() {
    Walls<Dim> walls;
    walls.fill(mirror<Dim>);
    return room<Dim>(walls);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(all_walls_together_give_what_is_given, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    for (const Law<Dim>& law : laws<Dim>()) BOOST_TEST_CONTEXT(law.name) {
            const bool mirrors = law.only_mirrors;
            Walls<Dim> walls;
            walls.fill(law.lower());
            walls[0] = mirror<Dim>;
            walls[3] = law.upper();
            const Accounts<Dim> found = accounts_of(law.build, room<Dim>(walls));
            typename Accounts<Dim>::Of sum;
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

/// Of images in a corner those of the moving warm wall take energy, not those of the mirror beside it, whatever the
/// order of directions.
BOOST_AUTO_TEST_CASE_TEMPLATE(mirrors_take_no_energy_in_corners, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    for (const Law<Dim>& law : laws<Dim>()) {
        if (law.only_mirrors) continue;
        BOOST_TEST_CONTEXT(law.name) for (const std::size_t warm_side : {0U, 3U}) {
            Walls<Dim> walls;
            walls.fill(mirror<Dim>);
            walls[warm_side] = law.upper();
            if (warm_side < 2) walls[warm_side]->velocity = 0.3 * Point<Dim>::Unit(1);
            const Accounts<Dim> found = accounts_of(law.build, room<Dim>(walls));
            const auto& of = found.side[warm_side];
            const double size = std::abs(found.all.work) + std::abs(found.all.heat);
            BOOST_TEST(size > 1e-3);
            BOOST_TEST(std::abs(of.heat - found.all.heat) < 1e-11 * size);
        }
    }
}

/// Walls that face each other are farther apart than particles see: each gives as if it were alone.
BOOST_AUTO_TEST_CASE_TEMPLATE(a_wall_gives_what_it_gives_alone, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    for (const Law<Dim>& law : laws<Dim>()) BOOST_TEST_CONTEXT(law.name) {
            const Wall<Dim> lower = law.lower(), upper = law.upper();
            const Accounts<Dim> both = accounts_of(law.build, room<Dim>({{{}, {}, lower, upper}})),
                                alone = accounts_of(law.build, room<Dim>({{{}, {}, {}, upper}}));
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
BOOST_AUTO_TEST_CASE_TEMPLATE(forces_of_a_pair_potential_are_those_of_all_pairs, In,
                              PlaneAndSpace) {
    constexpr int Dim = In::value;
    const Box<Dim> box = mirrors<Dim>();
    const Accounts<Dim> found = accounts_of(built<Dim, PairPotentialModel>(range), box);
    const auto all = particles<Dim>();
    const Points<Dim>& x = all.reference_position;
    const auto images = images_behind_walls<Dim>(box, range, x, Points<Dim>::Zero(Dim, x.cols()));
    const Lucy<Dim> w(range);
    std::array<Point<Dim>, 2 * Dim> expected;
    expected.fill(Point<Dim>::Zero());
    Eigen::VectorXd torque = Eigen::VectorXd::Zero(2 * Dim - 3);
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        for (Eigen::Index k = 0; k < images.count(); ++k) {
            const Point<Dim> apart = x.col(i) - images.position.col(k);
            if (apart.norm() >= range) continue;
            const auto j = images.owner[static_cast<std::size_t>(k)];
            int side = 0;
            for (int s = 0; s < 2 * Dim; ++s)
                if (s % 2 == 1 ? images.position(s / 2, k) > box.wall(s / 2, true).at
                               : images.position(s / 2, k) < box.wall(s / 2, false).at)
                    side = s;
            const Point<Dim> force = all.mass[static_cast<std::size_t>(i)] *
                                     all.mass[static_cast<std::size_t>(j)] *
                                     w.minus_slope_over_r(apart.norm()) * apart;
            expected[static_cast<std::size_t>(side)] += force;
            const Point<Dim> at = x.col(i);
            if constexpr (Dim == 2) torque[0] += at.x() * force.y() - at.y() * force.x();
            if constexpr (Dim == 3) torque += at.cross(force);
        }
    BOOST_TEST((found.torque - torque).norm() < 1e-12 * expected[0].norm() * x.norm());
    BOOST_TEST(torque.norm() > 1e-3);
    for (std::size_t side = 0; side < 2 * Dim; ++side)
        BOOST_TEST((found.side[side].impulse - expected[side]).norm() <
                   1e-12 * expected[side].norm());
}

/// Stress acts across r_ij and turns a body: that is not what walls give that nothing is near.
BOOST_AUTO_TEST_CASE_TEMPLATE(walls_out_of_reach_give_no_torque, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    Box<Dim> box;
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true}) {
            Wall<Dim> wall = mirror<Dim>;
            wall.at = upper ? 100.0 : -100.0;
            box.set_wall(a, upper, wall);
        }
    for (const Law<Dim>& law : laws<Dim>()) BOOST_TEST_CONTEXT(law.name) {
            const Accounts<Dim> found = accounts_of(law.build, box);
            BOOST_TEST(found.torque.norm() == 0.0);
            if (law.name == std::string("solid")) BOOST_TEST(std::abs(found.turning) > 1e-2);
            BOOST_TEST(found.all.heat == 0.0);
        }
}

/// Over a run: reflections, lists of many ages, gravity. What the walls have given, wall by wall, is what has
/// come to the particles.
BOOST_AUTO_TEST_CASE_TEMPLATE(walls_add_up_over_a_run, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    const auto run = [](const Build<Dim>& build, bool falls, int threads) {
        set_threads(threads);
        const auto model = build(mirrors<Dim>());
        const double g = falls ? 0.05 : 0.0, end = Dim == 2 ? 10.0 : 2.0;
        if (falls) model->add(std::make_unique<Gravity<Dim>>(-g * Point<Dim>::Unit(1)));
        std::vector<double> y(model->layout().size(), 0.0);
        const State<Dim> state(model->layout(), y);
        const auto values = random_state(*build({}), 3);
        state.position() = model->particles().reference_position;
        state.velocity() = 0.5 * ConstState<Dim>(build({})->layout(), values).velocity();
        if (state.has(Field::density)) state.density().setConstant(1.1);
        if (state.has(Field::energy)) state.energy().setConstant(0.5);
        const auto before = measure_invariants<Dim>(*model, y);
        Motion<Dim> motion(*model, y, {.method = "rk4", .dt = 0.05});
        motion.advance_to(end);
        set_threads(1);
        const auto after = measure_invariants<Dim>(*model, motion.y());
        Point<Dim> sum = Point<Dim>::Zero();
        for (int a = 0; a < Dim; ++a)
            for (const bool upper : {false, true})
                sum += motion.state().field(Field::wall_impulse(a, upper));
        sum.y() -= before.mass * g * end;
        BOOST_TEST(model->reflections() > 2U);
        BOOST_TEST((sum - (after.momentum - before.momentum)).norm() < 1e-9 * before.mass);
        return std::vector<double>(motion.y().begin(), motion.y().end());
    };
    for (const Law<Dim>& law : laws<Dim>()) {
        if (law.name != std::string("Lucy") && law.name != std::string("pairs")) continue;
        for (const bool falls : {false, true}) {
            const auto once = run(law.build, falls, 1);
            BOOST_TEST((once == run(law.build, falls, 2)));
        }
    }
}

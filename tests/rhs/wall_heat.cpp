// SPDX-License-Identifier: GPL-3.0-or-later
// Heat through each wall by itself: what a model with that wall alone books; and the work of a moving one, the
// force on it times its velocity.
#include "support/random_state.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/gravity.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

constexpr double size = 6.0;
const Wall<2> below{WallKind::no_slip, 0.0, Point<2>::Zero(), 1.4},
    above{WallKind::no_slip, size, {0.3, 0.0}, 0.8};

const Fluid by_gradients{IdealGas{}, NewtonViscosity{0.1, 0.3}, FourierConduction{0.4}},
    by_pairs{IdealGas{}, NewtonViscosity{0.1, 0.3}, FourierConduction{0.4}, true};
const Scheme plain{.density = Density::continuity, .range = 2.4},
    with_viscosity{.density = Density::continuity, .viscosity = 1.0, .range = 2.4};

Particles<2> particles() {
    Points<2> x = square_lattice<2>({6, 6});
    x.colwise() += Point<2>(0.5, 0.5) - Point<2>(x.rowwise().minCoeff());
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> u(-0.2, 0.2);
    for (auto& c : x.reshaped()) c += u(random);
    auto particles = make_particles<2>(x, 1.0);
    for (double& m : particles.mass) m += u(random);
    return particles;
}

/// Periodic along the walls, or with mirrors at the sides: corners are images of images.
Box<2> between(const std::optional<Wall<2>>& lower, const std::optional<Wall<2>>& upper,
               bool mirrors) {
    Box<2> box({mirrors ? 0.0 : size, 0.0});
    if (mirrors) {
        box.set_wall(0, false, {WallKind::mirror, 0.0});
        box.set_wall(0, true, {WallKind::mirror, size});
    }
    if (lower) box.set_wall(1, false, *lower);
    if (upper) box.set_wall(1, true, *upper);
    return box;
}

/// Rates of the accounts, of the same particles in the same state between whichever walls.
struct Accounts {
    double work, heat, force, bottom = 0.0, top = 0.0;
};
Accounts accounts_of(const Fluid& fluid, const Scheme& scheme, const Box<2>& box) {
    FluidModel<2> model(particles(), fluid, scheme, box);
    const FluidModel<2> alone(particles(), fluid, scheme, between({}, {}, false));
    const auto values = random_state(alone, 9);
    const ConstState<2> state(alone.layout(), values);
    std::vector<double> y(model.layout().size(), 0.0);
    const State<2> here(model.layout(), y);
    for (const Field field : {Field::position, Field::velocity, Field::density})
        here.field(field) = state.field(field);
    here.energy() = state.energy().cwiseAbs().array() + 0.5;
    const auto rates = rates_of(model, y);
    const ConstState<2> rate(model.layout(), rates);
    const auto of = [&](Field field) { return rate.has(field) ? rate.field(field)(0, 0) : 0.0; };
    return {of(Field::work), of(Field::heat), of(Field::impulse), of(Field::wall_heat(1, false)),
            of(Field::wall_heat(1, true))};
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_wall_gives_what_it_would_give_alone) {
    for (const Fluid& fluid : {by_gradients, by_pairs})
        for (const Scheme& scheme : {plain, with_viscosity})
            for (const bool mirrors : {false, true}) {
                const Accounts both = accounts_of(fluid, scheme, between(below, above, mirrors)),
                               lower = accounts_of(fluid, scheme, between(below, {}, mirrors)),
                               upper = accounts_of(fluid, scheme, between({}, above, mirrors));
                BOOST_TEST(std::abs(both.bottom) > 1e-2);
                BOOST_TEST(std::abs(both.top) > 1e-2);
                const double most = 1e-11 * (std::abs(both.bottom) + std::abs(both.top));
                BOOST_TEST(std::abs(both.bottom - lower.heat) < most);
                BOOST_TEST(std::abs(both.bottom + both.top - both.heat) < most);
                BOOST_TEST(std::abs(both.top - upper.heat) < most);
                BOOST_TEST(std::abs(both.work - upper.work) < most);
                BOOST_TEST(lower.work == 0.0);
                if (!mirrors)  // these give forces along the plates
                    BOOST_TEST(std::abs(upper.work - upper.force * above.velocity.x()) < most);
            }
}

/// Mirrors pass no energy, and have no account of their own.
BOOST_AUTO_TEST_CASE(walls_without_heat_have_no_account) {
    const FluidModel<2> model(particles(), by_pairs, plain, between(below, {}, true));
    BOOST_TEST(model.layout().has(Field::wall_heat(1, false)));
    for (const bool upper : {false, true})
        BOOST_TEST(!model.layout().has(Field::wall_heat(0, upper)));
    BOOST_TEST(!model.layout().has(Field::wall_heat(1, true)));
}

/// Particles that fall through a floor come back above it with the energy that they had.
BOOST_AUTO_TEST_CASE(a_reflection_under_gravity_keeps_the_energy) {
    Box<2> box;
    box.set_wall(1, false, {WallKind::mirror, 0.0});
    const auto all = particles();
    ParticleModel<2> model(all, box);
    model.add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.1)));
    std::vector<double> y(model.layout().size(), 0.0);
    State<2>(model.layout(), y).position() = all.reference_position;
    // Parabolas, which the method finds exactly.
    Motion<2> motion(model, y, {.method = "rk4", .dt = 0.1});
    const auto before = measure_invariants<2>(model, motion.y());
    motion.advance_to(60.0);
    const auto after = measure_invariants<2>(model, motion.y());
    BOOST_TEST(model.reflections() > 100u);
    BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) < 1e-12 * before.energy);
    BOOST_TEST(after.work == 0.0);
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-9);
    for (Eigen::Index i = 0; i < all.reference_position.cols(); ++i)
        BOOST_TEST(motion.state().position()(1, i) >= 0.0);
}

/// A particle too slow to stay above the floor is put there by the floor's work.
BOOST_AUTO_TEST_CASE(a_floor_works_where_motion_is_not_enough) {
    Box<2> box;
    box.set_wall(1, false, {WallKind::mirror, 0.0});
    ParticleModel<2> model(particles(), box);
    model.add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.1)));
    std::vector<double> y(model.layout().size(), 0.0);
    const State<2> state(model.layout(), y);
    state.position() = model.particles().reference_position;
    state.position()(1, 0) = -0.5;
    state.velocity()(1, 0) = -1e-3;
    const auto before = measure_invariants<2>(model, y);
    model.settle(0.0, y);
    const auto after = measure_invariants<2>(model, y);
    BOOST_TEST(state.position()(1, 0) == 0.5);
    BOOST_TEST(state.velocity()(1, 0) == 0.0);
    BOOST_TEST(after.work > 0.0);
    BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) < 1e-13 * before.energy);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The right-hand side is a function of (t, y): no thread count, no history and no list age in its bits
// (list_order.cpp: of flows). States without meaning are named.
#include "support/plane_and_space.hpp"
#include "support/random_state.hpp"
#include <spam/core/parallel.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <limits>

using namespace spam;
using namespace spam::test;

namespace {

const ElasticSolid solid{0.7, 0.4};
const Scheme everything{.density = Density::chain_rule,
                        .transport = Transport::monaghan,
                        .angular_momentum = AngularMomentum::torque_pair,
                        .viscosity = 0.3,
                        .range = 3.0};

template <int Dim>
std::vector<double> moved(const Model<Dim>& model, std::vector<double> y, double distance,
                          unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-distance, distance);
    for (auto& x : State<Dim>(model.layout(), y).position().reshaped()) x += u(random);
    return y;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(no_bit_depends_on_the_age_of_the_list, In, PlaneAndSpace) {
    constexpr int Dim = In::value;
    for (Scheme scheme : all_schemes<Dim>()) {
        scheme.range = 3.0;
        const auto particles = jittered_particles<Dim>(Dim == 2 ? 12 : 6, 41);
        SmoothParticleModel<Dim> used(particles, solid, scheme), fresh(particles, solid, scheme);
        const auto start = random_state(used, 42);
        rates_of(used, start);
        // By less than half the skin: the old list stays.
        const auto y = moved(used, start, Dim == 2 ? 0.09 : 0.07, 43);
        const auto with_old_list = rates_of(used, y), with_new_list = rates_of(fresh, y);
        BOOST_TEST(used.list_builds() == 1U);
        BOOST_TEST((with_old_list == with_new_list), scheme.describe());
        // After a time as a cloud slots are no longer numbers.
        rates_of(used, moved(used, start, 2.0, 44));
        BOOST_TEST((rates_of(used, y) == with_new_list), scheme.describe());
    }
}

BOOST_AUTO_TEST_CASE(a_body_that_turns_and_flies_keeps_its_list) {
    SmoothParticleModel<2> model(jittered_particles<2>(30, 47), solid, {.range = 3.0});
    auto y = random_state(model, 48);
    const Points<2> start = model.particles().reference_position;
    for (int step = 0; step <= 100; ++step) {
        const Eigen::Rotation2Dd turn(0.02 * std::numbers::pi * step);
        State<2>(model.layout(), y).position() =
            (turn.toRotationMatrix() * start).colwise() + Point<2>(0.7 * step, -0.2 * step);
        rates_of(model, y);
    }
    BOOST_TEST(model.list_builds() == 1U);
}

// Nor does a crystal that flies around a periodic box, again and again over its border.
BOOST_AUTO_TEST_CASE(a_crystal_that_flies_around_its_box_keeps_its_list) {
    const Box<2> box({24.0, 12.0 * std::sqrt(3.0)});
    const auto particles = make_particles<2>(triangular_block(24, 24), 1.0, 1.0, box);
    PairPotentialModel<2> flying(particles, 3.0, box);
    std::vector<double> y(flying.layout().size());
    State<2>(flying.layout(), y).position() = particles.reference_position;
    y = moved(flying, y, 0.1, 49);
    for (int step = 0; step < 100; ++step) {
        const Points<2> start = State<2>(flying.layout(), y).position();
        State<2>(flying.layout(), y).position() = start.colwise() + Point<2>(0.7, -0.4);
        PairPotentialModel<2> fresh(particles, 3.0, box);
        BOOST_TEST((rates_of(flying, y) == rates_of(fresh, y)));
    }
    BOOST_TEST(flying.list_builds() == 1U);
}

// In a flow lists are sorted anew and their skins chosen anew.
BOOST_AUTO_TEST_CASE(lists_of_a_flow_do_not_change_its_rates) {
    const Box<2> box({24.0, 12.0 * std::sqrt(3.0)});
    const auto particles = make_particles<2>(triangular_block(24, 24), 1.0, 1.0, box);
    PairPotentialModel<2> flow(particles, 3.0, box);
    std::vector<double> y(flow.layout().size());
    State<2>(flow.layout(), y).position() = particles.reference_position;
    for (unsigned step = 0; step < 120; ++step) {
        y = moved(flow, y, step < 60 ? 0.2 : 0.02, step);
        PairPotentialModel<2> fresh(particles, 3.0, box);
        BOOST_TEST((rates_of(flow, y) == rates_of(fresh, y)));
    }
    BOOST_TEST(flow.list_builds() > 10U);
    BOOST_TEST(flow.list_builds() < 100U);
}

BOOST_AUTO_TEST_CASE(one_and_two_threads_give_the_same_bits) {
    const auto particles = jittered_particles<2>(40, 45);  // above the threshold for threads
    BOOST_TEST(particles.size() > parallel_threshold);
    SmoothParticleModel<2> model(particles, solid, everything);
    const auto y = random_state(model, 46);
    std::vector<std::vector<double>> results;
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        SmoothParticleModel<2> again(particles, solid, everything);
        results.push_back(rates_of(again, y));
    }
    set_threads(1);
    BOOST_TEST((results[0] == results[1]));
    BOOST_TEST((results[0] == results[2]));
    const auto cube = jittered_particles<3>(11, 47);
    SmoothParticleModel<3> solid_cube(cube, solid, {.range = 2.2});
    const auto z = random_state(solid_cube, 48);
    const auto one = rates_of(solid_cube, z);
    set_threads(2);
    BOOST_TEST((rates_of(solid_cube, z) == one));
    set_threads(1);
}

BOOST_AUTO_TEST_CASE(states_without_meaning_are_named) {
    SmoothParticleModel<2> model(jittered_particles<2>(6, 49), solid, {});
    auto y = random_state(model, 50);
    rates_of(model, y);
    BOOST_TEST(model.failure().empty());
    State<2>(model.layout(), y).density()(0, 7) = -0.1;
    const auto rates = rates_of(model, y);
    BOOST_TEST(std::isnan(rates[0]));
    BOOST_TEST((model.failure().find("density -0.1 of particle " +
                                     std::to_string(model.particles().id[7])) == 0U),
               model.failure());
    y[0] = std::numeric_limits<double>::infinity();
    rates_of(model, y);
    BOOST_TEST((model.failure().find("position") != std::string::npos));
    y = random_state(model, 50);
    rates_of(model, y);
    BOOST_TEST(model.failure().empty());
}

BOOST_AUTO_TEST_CASE(springs_pull_together) {
    BondedModel<2> model(make_particles<2>(triangular_hexagon(3), 1.5), {});
    BOOST_TEST(model.pairs() == 90U);  // 37 particles: (37 * 6 - 6 corners * 3 - 12 sides * 2) / 2
    auto y = moved(model, random_state(model, 51), 0.05, 52);
    const auto y_dot = rates_of(model, y);
    const ConstState<2> rate(model.layout(), y_dot);
    BOOST_TEST(rate.velocity().rowwise().sum().norm() < 1e-14);
    // Forces are minus the slope of the energy, by central differences.
    for (const std::size_t k : {0UL, 13UL, 50UL}) {
        const double h = 1e-5;
        auto forward = y, backward = y;
        forward[k] += h;
        backward[k] -= h;
        const double slope =
            (model.internal_energy(forward) - model.internal_energy(backward)) / (2.0 * h);
        BOOST_TEST(std::abs(1.5 * y_dot[2 * model.particles().size() + k] + slope) < 1e-9);
    }
}

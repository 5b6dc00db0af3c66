// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that part and join, and what they had.
#include "fragmenting_bar/body_ledger.hpp"

#include <spam/diagnostics/invariants.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;

namespace {

/// Two hexagons side by side with a gap, moving apart and turning.
struct TwoHexagons {
    explicit TwoHexagons(double gap)
        : model(make_particles<2>(points(gap), 1.5), ElasticSolid{0.4, 0.4},
                {.angular_momentum = AngularMomentum::torque_pair}) {
        y = initial_state<2>(model, 1.15, 0.4, [](const Point<2>& x) {
            return Point<2>(x.x() > 0.0 ? 1.0 : -1.0, 0.3 * x.x());
        });
        for (auto& e : State<2>(model.layout(), y).energy().reshaped()) e = 0.25;
    }
    static Points<2> points(double gap) {
        const Points<2> one = triangular_hexagon(2);
        Points<2> both(2, 2 * one.cols());
        both << one, one;
        both.row(0).head(one.cols()).array() -= 2.0 + 0.5 * gap;
        both.row(0).tail(one.cols()).array() += 2.0 + 0.5 * gap;
        return both;
    }
    void move_apart(double by) {
        auto x = State<2>(model.layout(), y).position();
        for (Eigen::Index i = 0; i < x.cols(); ++i) x(0, i) += x(0, i) > 0.0 ? by : -by;
    }

    SmoothParticleModel<2> model;
    std::vector<double> y;
};

}  // namespace

BOOST_AUTO_TEST_CASE(totals_of_bodies_add_up_to_the_invariants) {
    TwoHexagons two(4.0);
    BOOST_TEST_REQUIRE(two.model.particles().bodies() == 2);
    const auto totals = totals_of_bodies(two.model, two.y);
    const auto all = measure_invariants(two.model, two.y);
    BOOST_TEST(totals[0].particles + totals[1].particles == two.model.particles().size());
    BOOST_TEST(totals[0].mass + totals[1].mass == all.mass);
    BOOST_TEST(std::abs(totals[0].angular_momentum + totals[1].angular_momentum -
                        all.angular_momentum[0]) < 1e-12 * std::abs(all.angular_momentum[0]));
    BOOST_TEST(std::abs(totals[0].energy + totals[1].energy - all.energy) < 1e-12 * all.energy);
    BOOST_TEST((totals[0].momentum + totals[1].momentum - all.momentum).norm() < 1e-12);
    BOOST_TEST(totals[0].momentum.x() * totals[1].momentum.x() < 0.0);
}

BOOST_AUTO_TEST_CASE(bodies_join_while_they_can_act_on_each_other) {
    TwoHexagons two(2.5);  // apart by lattice, within the range of 3
    BodyLedger ledger;
    BOOST_TEST(ledger.find_bodies(0.0, two.model, two.y, 0.0));
    BOOST_TEST(two.model.particles().bodies() == 1);
    BOOST_TEST(ledger.entries().size() == 1u);
    BOOST_TEST(!ledger.find_bodies(0.1, two.model, two.y, 0.0));

    two.move_apart(0.3);
    BOOST_TEST(
        !ledger.find_bodies(1.0, two.model, two.y, 0.2));  // might touch before the next search
    BOOST_TEST(ledger.find_bodies(1.0, two.model, two.y, 0.0));
    BOOST_TEST(two.model.particles().bodies() == 2);
    const auto& parted = ledger.entries().back();
    BOOST_TEST(parted.t == 1.0);
    for (const auto& parents : parted.parents) {
        BOOST_TEST_REQUIRE(parents.size() == 1u);
        BOOST_TEST(parents[0] == 0u);
    }
    two.move_apart(-0.3);
    BOOST_TEST(ledger.find_bodies(2.0, two.model, two.y, 0.0));
    BOOST_TEST(ledger.entries().back().parents[0].size() == 2u);
}

BOOST_AUTO_TEST_CASE(bodies_that_fly_towards_each_other_come_nearer_twice_as_fast) {
    for (const double until_next : {0.051, 0.04}) {
        TwoHexagons two(2.5);
        BodyLedger ledger;
        ledger.find_bodies(0.0, two.model, two.y, 0.0);
        two.move_apart(0.3);  // 0.1 out of reach
        const State<2> state(two.model.layout(), two.y);
        for (Eigen::Index i = 0; i < state.velocity().cols(); ++i)
            state.velocity().col(i) << (state.position()(0, i) > 0.0 ? -1.0 : 1.0), 0.0;
        BOOST_TEST(ledger.find_bodies(1.0, two.model, two.y, until_next) == (until_next < 0.045));
    }
}

BOOST_AUTO_TEST_CASE(a_body_that_loses_angular_momentum_is_noticed) {
    TwoHexagons two(4.0);
    BodyLedger ledger;
    ledger.find_bodies(0.0, two.model, two.y, 0.0);
    auto v = State<2>(two.model.layout(), two.y).velocity();
    const double L = ledger.entries().front().bodies[0].angular_momentum;
    for (Eigen::Index i = 0; i < v.cols(); ++i)
        if (two.model.particles().body[static_cast<std::size_t>(i)] == 0) v(1, i) *= 0.99;
    ledger.close(5.0, two.model, two.y);
    BOOST_TEST(ledger.entries().back().largest_L_change > 0.005 * std::abs(L));
    BOOST_TEST(ledger.entries().back().largest_momentum_change > 0.1);
}

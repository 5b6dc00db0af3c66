// SPDX-License-Identifier: GPL-3.0-or-later
// What constrains the angular momentum of the standard hexagon over a turn, [HHM04] VII and VIII.
#include "support/effort.hpp"
#include <spam/integrate/integrator.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>

using namespace spam;

namespace {

constexpr double turn = 160.0 * std::numbers::pi;

RunRecord turn_hexagon(const Scheme& scheme, double t_end, double output_every) {
    SmoothParticleModel<2> model(make_particles<2>(triangular_hexagon(8), 1.0),
                                 ElasticSolid::triangular_lattice(), scheme);
    auto y0 = initial_state<2>(model, std::sqrt(4.0 / 3.0), std::sqrt(3.0 / 16.0),
                               rigid_rotation(0.1 / 8));
    Plan<2> plan;
    plan.t_end = t_end;
    plan.output_every = output_every;
    plan.snapshot_every = t_end;
    return run_in_memory<2>({kept_elsewhere<2>(model), std::move(y0), std::move(plan)},
                            {.method = "rk4", .dt = 0.1});
}

/// Largest relative change of a column between rows in [from, to].
double change_within(const History& h, const char* column, double from, double to) {
    const auto t = h.column("t"), values = h.column(column);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t k = 0; k < t.size(); ++k) {
        if (t[k] < from || t[k] > to) continue;
        low = std::min(low, values[k]);
        high = std::max(high, values[k]);
    }
    return (high - low) / std::abs(values.front());
}

}  // namespace

BOOST_AUTO_TEST_CASE(particle_torques_keep_the_angular_momentum) {
    for (const auto transport : {Transport::average, Transport::monaghan}) {
        const auto run = turn_hexagon(
            {.transport = transport, .angular_momentum = AngularMomentum::torque_particle},
            test::effort(turn, turn / 10.0), turn / 100.0);
        BOOST_TEST_REQUIRE(run.complete);
        const History& h = run.history;
        BOOST_TEST(h.largest_change("angular_momentum") / h.first("angular_momentum") < 1e-9);
        // Its factors jump where a torque changes sign, and RK4 is of order one there.
        const double dE = h.largest_change("energy") / h.first("energy");
        BOOST_TEST(dE < 2e-5);
        BOOST_TEST(dE > 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(gauss_keeps_both_while_its_denominator_is_healthy) {
    const auto run = turn_hexagon(
        {.transport = Transport::monaghan, .angular_momentum = AngularMomentum::gauss}, turn, 0.1);
    BOOST_TEST_REQUIRE(run.complete);
    double constrained = 0.0;
    for (std::size_t k = 0; k < run.remarks.size(); ++k) {
        const auto& [t, remark] = run.remarks[k];
        const double until =
            k + 1 < run.remarks.size() ? run.remarks[k + 1].first : run.statistics.t_end;
        const double L_change = change_within(run.history, "angular_momentum", t, until - 0.15);
        if (remark.what == "gauss constraint works") {
            constrained += until - t;
            BOOST_TEST(L_change < 1e-9, "from t = " << t << " to " << until);
        } else if (until - t > 5.0) {
            BOOST_TEST(L_change > 1e-6, "singular, and yet kept, from t = " << t);
        }
    }
    BOOST_TEST(run.remarks.size() >= 4u);  // it becomes singular again and again
    BOOST_TEST(constrained > 0.0);
    const History& h = run.history;
    BOOST_TEST(h.largest_change("energy") / h.first("energy") < 1e-7);
    BOOST_TEST(h.last("angular_momentum") < 0.9 * h.first("angular_momentum"));
    BOOST_TEST_MESSAGE("constrained for " << constrained / turn << " of the turn");
}

BOOST_AUTO_TEST_CASE(gauss_can_stop_where_it_is_singular) {
    const auto run = turn_hexagon({.transport = Transport::monaghan,
                                   .angular_momentum = AngularMomentum::gauss,
                                   .gauss_singular = GaussSingular::stop},
                                  turn, 1.0);
    BOOST_TEST(!run.complete);
    BOOST_TEST(run.statistics.t_end < 30.0);
    BOOST_TEST(run.statistics.t_end > 1.0);  // not at the start, which needs no constraint
    BOOST_TEST(run.statistics.stopped.find("singular") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(viscosity_heats_and_keeps_the_energy) {
    const auto run = turn_hexagon({.transport = Transport::plain, .viscosity = 1.0},
                                  test::effort(turn / 4.0, turn / 20.0), turn / 100.0);
    BOOST_TEST_REQUIRE(run.complete);
    const History& h = run.history;
    BOOST_TEST(h.largest_change("energy") / h.first("energy") < 1e-8);
    BOOST_TEST(h.last("internal") > 0.0);
    BOOST_TEST(h.last("kinetic") < h.first("kinetic"));
}

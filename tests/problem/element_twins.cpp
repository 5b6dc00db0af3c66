// SPDX-License-Identifier: GPL-3.0-or-later
// The finite-element twins of [HH07] 13: the bar that necks, the ball that bounces back from the plate or goes
// through it. Numbers are those of another program with the same elements; where contacts and breaking make a
// run depend on its last digits, bounds are what steps from 0.1 to 0.25 and other meshes of the ball give.
#include "ball_plate/elements.hpp"
#include "support/effort.hpp"
#include "tension_test/elements.hpp"
#include <spam/core/parallel.hpp>
#include <spam/material/plastic_fields.hpp>
#include <spam/problem/run_in_memory.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;

namespace {

IntegratorOptions rk4(double dt) {
    IntegratorOptions options;
    options.dt = dt;
    return options;
}

/// One thread: so few elements are quicker so, and others may be at work.
RunRecord hit(const ball_plate_elements::Parameters& p, double t_end) {
    set_threads(1);
    const auto impact = ball_plate_elements::make_impact(p);
    Plan<2> plan;
    plan.t_end = t_end;
    plan.output_every = t_end / 20.0;
    plan.snapshot_every = t_end;
    plan.record(ball_plate_elements::columns_of());
    auto run = run_in_memory<2>({impact.model, impact.y0, std::move(plan)},
                                rk4(ball_plate_elements::step));
    BOOST_TEST(run.complete);
    for (const Drift& drift : run.drifts)
        BOOST_TEST(drift.kept(), drift.name << " " << drift.change);
    BOOST_TEST_MESSAGE("v = " << p.speed << ", eps_f = " << p.failure_strain << ": ball "
                              << run.history.last("ball_speed") << ", broken "
                              << run.history.last("elements_broken") << ", largest strain "
                              << run.history.last("largest_plastic_strain") << ", sag "
                              << run.history.last("sag"));
    return run;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_bar_yields_and_necks) {
    const tension_elements::Parameters p;
    const auto bar = tension_elements::make_bar(p);
    Plan<2> plan;
    plan.t_end = 64.0;
    plan.output_every = 16.0;
    plan.snapshot_every = 64.0;
    plan.record(tension_elements::columns_of(p));
    const auto run = run_in_memory<2>({bar.model, bar.y0, std::move(plan)}, rk4(0.25));
    for (const Drift& drift : run.drifts)
        BOOST_TEST(drift.kept(), drift.name << " " << drift.change);
    const auto t = run.history.column("t"), strain = run.history.column("largest_plastic_strain"),
               neck = run.history.column("neck"), length = run.history.column("length");
    const struct {
        double t, nominal, largest;
    } known[] = {{32.0, 0.050, 0.048}, {48.0, 0.075, 0.081}, {64.0, 0.100, 0.113}};
    for (std::size_t k = 0; k < 3; ++k) {
        BOOST_TEST_MESSAGE("t = " << t[k + 2] << ": " << strain[k + 2] << ", neck " << neck[k + 2]);
        BOOST_TEST(t[k + 2] == known[k].t);
        BOOST_TEST(std::abs(length[k + 2] / 60.0 - 1.0 - known[k].nominal) < 1e-3);
        BOOST_TEST(std::abs(strain[k + 2] - known[k].largest) < 2e-3);
        BOOST_TEST(neck[k + 2] <= 3.0);
    }
}

BOOST_AUTO_TEST_CASE(a_slow_ball_bounces_back_and_leaves_the_plate_bent) {
    for (const double failure : {1.0, 2.0}) {
        if (failure > 1.0 && !test::long_runs()) break;  // the same law once more
        ball_plate_elements::Parameters p;
        p.speed = 0.25;
        p.failure_strain = failure;
        const RunRecord run = hit(p, 500.0);
        BOOST_TEST(std::abs(run.history.last("ball_speed") + 0.035) < 0.01);
        BOOST_TEST(run.history.last("sag") > 4.0);
        BOOST_TEST(run.history.last("elements_broken") < 15.0);
    }
}

BOOST_AUTO_TEST_CASE(a_fast_ball_goes_through) {
    const RunRecord run = hit({}, 200.0);
    BOOST_TEST(std::abs(run.history.last("ball_speed") - 0.24) < 0.02);
    BOOST_TEST(std::abs(run.history.last("elements_broken") - 88.0) < 8.0);
}

BOOST_AUTO_TEST_CASE(a_plate_with_free_ends_takes_a_slow_ball_along) {
    if (!test::effort(true, false)) return;  // the same law once more
    ball_plate_elements::Parameters p;
    p.speed = 0.25;
    p.held = false;
    const RunRecord run = hit(p, 300.0);
    // Both at the speed of their common centre of mass, 0.25 201/841, more or less.
    BOOST_TEST(std::abs(run.history.last("ball_speed") - 0.06) < 0.03);
    BOOST_TEST(run.history.last("elements_broken") < 15.0);
}

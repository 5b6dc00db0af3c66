// SPDX-License-Identifier: GPL-3.0-or-later
// A loop over time of one's own, in one file: a body falls, and is thrown upwards whenever it has reached
// the ground. Nothing is written; what is wanted is read from the state.
#include <spam/external/gravity.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;

BOOST_AUTO_TEST_CASE(a_body_that_is_thrown_upwards_at_the_ground) {
    const double g = 0.01, height = 2.0;
    const auto solid = ElasticSolid::triangular_lattice();
    Points<2> points = triangular_block(6, 5);
    points.row(1).array() += height - points.row(1).minCoeff();
    SmoothParticleModel<2> body(make_particles<2>(points, 1.0), solid, Scheme{});
    body.add(std::make_unique<Gravity<2>>(Point<2>(0.0, -g)));
    const auto y0 = initial_state<2>(body, std::sqrt(4.0 / 3.0), solid.eta,
                                     [](const Point<2>&) { return Point<2>(0.0, 0.0); });

    Motion<2> motion(body, y0, {.method = "rk4", .dt = 0.1});
    int throws = 0;
    while (motion.t() < 50.0) {
        motion.step(50.0);
        const bool reached = motion.edit([&](std::span<double> y) {
            State<2> state(body.layout(), y);
            if (state.position().row(1).minCoeff() > 0.0 || state.velocity().row(1).mean() > 0.0)
                return false;
            state.velocity().row(1) *= -1.0;  // as fast as it came
            return true;
        });
        if (reached) ++throws;
    }

    // It falls for sqrt(2 height/g) = 20 and rises as fast as it came, v = 0.2.
    const double t = 50.0 - std::sqrt(2.0 * height / g), v = std::sqrt(2.0 * height * g);
    BOOST_TEST(throws == 1);
    BOOST_TEST(motion.t() == 50.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(std::abs(motion.state().position().row(1).minCoeff() - (v * t - g * t * t / 2)) <
               0.05);
}

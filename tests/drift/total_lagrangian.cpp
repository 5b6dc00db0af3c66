// SPDX-License-Identifier: GPL-3.0-or-later
// What a total-Lagrangian solid keeps while it turns: the standard hexagon (217 particles, speed 0.1
// at the corners, RK4) and a ball in space. Without its penalty the hexagon drifts off into modes
// without energy.
#include "drift/turning_run.hpp"
#include "support/effort.hpp"
#include <spam/diagnostics/fits.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/lattices.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace spam;
using spam::test::effort;
using spam::test::run;

namespace {

constexpr double turn = 160.0 * std::numbers::pi;

TotalLagrangianModel<2> hexagon(double penalty) {
    return {make_particles<2>(triangular_hexagon(8), 1.0),
            StVenantKirchhoff::like(ElasticSolid::triangular_lattice()),
            {std::sqrt(4.0 / 3.0), 3.0, penalty}};
}

/// The penalty measured in lambda, which vanishes with Poisson's ratio.
struct MeasuredInLambda : StVenantKirchhoff {
    double stiffness() const { return lambda; }
};

/// The closest pair of a block of 16 x 16 particles that were given velocities of 0.02 at random.
template <class Law>
double closest_of_shaken(const Law& law, double t_end) {
    TotalLagrangianModel<2> model(make_particles<2>(triangular_block(16, 16), 1.0), law,
                                  {std::sqrt(4.0 / 3.0), 3.0, 0.1});
    std::mt19937_64 random(11);
    std::normal_distribution<double> g(0.0, 0.02 / std::numbers::sqrt2);
    const auto shaken = [&](const Point<2>&) { return Point<2>(g(random), g(random)); };
    return run<2>(model, shaken, {.dt = 0.25}, t_end, 10.0).smallest("closest_pair");
}

/// Simple cubic, those within `radius` of the middle.
Points<3> ball(int radius) {
    std::vector<Eigen::Vector3d> inside;
    for (int a = -radius; a <= radius; ++a)
        for (int b = -radius; b <= radius; ++b)
            for (int c = -radius; c <= radius; ++c)
                if (a * a + b * b + c * c <= radius * radius) inside.emplace_back(a, b, c);
    Points<3> points(3, static_cast<Eigen::Index>(inside.size()));
    for (std::size_t k = 0; k < inside.size(); ++k)
        points.col(static_cast<Eigen::Index>(k)) = inside[k];
    return points;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_hexagon_turns_four_times_and_nothing_changes) {
    auto model = hexagon(0.1);
    const double end = effort(4.0, 1.0) * turn;
    const History h = run<2>(model, rigid_rotation(0.1 / 8), {.dt = 0.1}, end, 10.0);
    BOOST_TEST(h.largest("shape_error") < 0.03);
    BOOST_TEST(h.smallest("closest_pair") > 0.97);
    BOOST_TEST(h.largest("p") < 1e-12);
    BOOST_TEST(h.largest("L") < 1e-11);
    BOOST_TEST(h.largest("energy") < 1e-8);
    BOOST_TEST(survival(h).t == end);
}

BOOST_AUTO_TEST_CASE(without_the_penalty_its_shape_is_lost) {
    auto model = hexagon(0.0);
    const History h =
        run<2>(model, rigid_rotation(0.1 / 8), {.dt = effort(0.2, 0.4)}, 9.0 * turn, 10.0);
    BOOST_TEST(h.largest("shape_error") > 0.5);
    BOOST_TEST(h.largest("p") < 1e-12);  // what does not depend on it is kept all the same
    BOOST_TEST(h.largest("L") < 1e-8);
}

BOOST_AUTO_TEST_CASE(what_is_not_kept_is_the_integrators) {
    std::vector<double> steps{0.8, 0.4, 0.2}, L, E;
    for (const double dt : steps) {
        auto model = hexagon(0.1);
        const History h = run<2>(model, rigid_rotation(0.1 / 8), {.dt = dt}, 0.5 * turn, 10.0);
        L.push_back(h.last("L"));
        E.push_back(h.last("energy"));
    }
    BOOST_TEST(observed_order(steps, L) > 4.5);
    BOOST_TEST(observed_order(steps, E) > 4.5);
}

BOOST_AUTO_TEST_CASE(a_ball_in_space_that_turns_and_rings) {
    TotalLagrangianModel<3> model(make_particles<3>(ball(3), 1.0), StVenantKirchhoff{0.4, 0.4},
                                  {1.0, 2.2, 0.1});
    const Eigen::Vector3d omega(0.02, -0.01, 0.03);
    const auto velocity = [&](const Point<3>& x) -> Point<3> {
        return omega.cross(x) + Point<3>(0.02 * x[0], -0.01 * x[1], 0.0) + Point<3>(0.1, 0.2, 0.0);
    };
    const History h = run<3>(model, velocity, {.dt = 0.05}, effort(250.0, 50.0), 10.0);
    BOOST_TEST(h.largest("shape_error") < 0.1);
    BOOST_TEST(h.largest("p") < 1e-12);
    BOOST_TEST(h.largest("L") < 1e-9);
    BOOST_TEST(h.largest("energy") < 1e-7);  // of the ringing, which RK4 damps
}

// Cork, foam and rods have small Poisson ratios, and some foams negative ones.
BOOST_AUTO_TEST_CASE(motions_without_strain_are_held_whatever_poissons_ratio_is) {
    const double end = effort(400.0, 200.0), eta = 0.43;
    for (const double lambda : {eta, 0.02 * eta, 0.002 * eta, 0.0, -0.3 * eta}) {
        const double closest = closest_of_shaken(StVenantKirchhoff{lambda, eta}, end);
        BOOST_TEST_MESSAGE("lambda/eta = " << lambda / eta << ": closest pair " << closest);
        BOOST_TEST(closest > 0.65);
    }
    const double free = closest_of_shaken(MeasuredInLambda{{0.002 * eta, eta}}, end);
    BOOST_TEST_MESSAGE("measured in lambda: " << free);
    BOOST_TEST(free < 0.3);
}

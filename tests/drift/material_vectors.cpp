// SPDX-License-Identifier: GPL-3.0-or-later
// What a solid with material vectors keeps while it turns and meets others: the standard hexagon (217
// particles, speed 0.1 at the corners) by leapfrog, a ball in space about a skew axis, and two hexagons that
// bounce.
#include "drift/turning_run.hpp"
#include "support/effort.hpp"
#include <spam/material/flowing_solid.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/neighbors/connected_parts.hpp>
#include <spam/rhs/contact.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/setup/drawn.hpp>
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
const double rho = std::sqrt(4.0 / 3.0);

MaterialVectorModel<2> hexagon(double penalty) {
    return {make_particles<2>(triangular_hexagon(8), 1.0),
            PolynomialSolid::like(ElasticSolid::triangular_lattice()),
            {rho, 3.0, penalty}};
}

/// Face-centred cubic with spacing 1, 249 particles.
Points<3> ball() {
    std::vector<Eigen::Vector3d> inside;
    const double a = std::sqrt(0.5);
    for (int i = -8; i <= 8; ++i)
        for (int j = -8; j <= 8; ++j)
            for (int k = -8; k <= 8; ++k) {
                const Eigen::Vector3d x = a * Eigen::Vector3d(i, j, k);
                if ((i + j + k) % 2 == 0 && x.norm() < 3.5) inside.push_back(x);
            }
    Points<3> points(3, static_cast<Eigen::Index>(inside.size()));
    for (std::size_t k = 0; k < inside.size(); ++k)
        points.col(static_cast<Eigen::Index>(k)) = inside[k];
    return points;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_hexagon_turns_and_nothing_but_its_breathing_changes) {
    auto model = hexagon(MaterialVectorScheme::default_penalty);
    const double end = effort(10.0, 0.5) * turn;
    const History h =
        run<2>(model, rigid_rotation(0.1 / 8), {.method = "leapfrog", .dt = 0.3}, end, 12.0);
    BOOST_TEST(h.largest("shape_error") < 0.0216);
    BOOST_TEST(h.smallest("closest_pair") > 0.999);
    BOOST_TEST(h.largest("p") < 1e-14);
    BOOST_TEST(h.largest("L") < 1e-12);
    BOOST_TEST(h.largest("energy") < 5e-6);
    BOOST_TEST(survival(h).t == end);
}

/// Other sizes, penalties, speeds and lattices: what grows is the breathing, with the size and with the square of
/// the speed, and nothing drifts.
BOOST_AUTO_TEST_CASE(whatever_the_size_the_penalty_the_order_and_the_speed) {
    struct Way {
        int size;
        double penalty, displaced, speed, turns, shape, closest;  // the last of that at the start
    };
    for (const Way& way :
         {Way{5, 2.0, 0.0, 0.1, 10.0, 0.0150, 0.998}, Way{16, 2.0, 0.0, 0.1, 1.0, 0.0395, 0.999},
          Way{32, 2.0, 0.0, 0.1, 0.25, 0.075, 0.999}, Way{8, 0.3, 0.0, 0.1, 5.0, 0.0218, 0.997},
          Way{8, 3.0, 0.0, 0.1, 5.0, 0.0211, 0.999}, Way{8, 2.0, 0.2, 0.1, 5.0, 0.0220, 0.98},
          Way{8, 2.0, 0.0, 0.4, 30.0, 0.31, 0.985}})
        BOOST_TEST_CONTEXT("n = " << way.size << ", kappa = " << way.penalty << ", displaced by "
                                  << way.displaced << ", speed " << way.speed) {
            Points<2> x = triangular_hexagon(way.size);
            std::mt19937_64 random(7);
            for (auto& component : x.reshaped())
                component += way.displaced * (2.0 * drawn(random) - 1.0);
            MaterialVectorModel<2> model(make_particles<2>(x, 1.0),
                                         PolynomialSolid::like(ElasticSolid::triangular_lattice()),
                                         {rho, 3.0, way.penalty});
            const double period = 2.0 * std::numbers::pi * way.size / way.speed;
            const History h = run<2>(model, rigid_rotation(way.speed / way.size),
                                     {.method = "leapfrog", .dt = 0.3},
                                     effort(way.turns, 0.4 * way.turns, 0.2) * period, 12.0);
            BOOST_TEST_MESSAGE("n = " << way.size << " kappa " << way.penalty << " displaced "
                                      << way.displaced << " speed " << way.speed << ": shape "
                                      << h.largest("shape_error") << ", closest "
                                      << h.smallest("closest_pair") << ", dL/L " << h.largest("L")
                                      << ", dE/E " << h.largest("energy"));
            BOOST_TEST(h.largest("shape_error") < way.shape);
            BOOST_TEST(h.smallest("closest_pair") > way.closest * closest_pair<2>(x, 1.0, {}));
            BOOST_TEST(h.largest("p") < 1e-14);
            BOOST_TEST(h.largest("L") < 1e-12);
            BOOST_TEST(h.largest("energy") < 1e-4);
        }
}

/// Tension of 0.35 where 0.09 is safe: clumps within a turn.
BOOST_AUTO_TEST_CASE(too_small_a_penalty_for_the_speed) {
    auto model = hexagon(0.1);
    const History h = run<2>(model, rigid_rotation(0.8 / 8), {.method = "leapfrog", .dt = 0.3},
                             0.25 * turn, 12.0);
    BOOST_TEST(h.smallest("closest_pair") < 0.5);
}

BOOST_AUTO_TEST_CASE(to_the_error_of_rk4) {
    auto model = hexagon(MaterialVectorScheme::default_penalty);
    const History h = run<2>(model, rigid_rotation(0.1 / 8), {.method = "rk4", .dt = 0.1},
                             effort(1.0, 0.1) * turn, 12.0);
    BOOST_TEST(h.largest("shape_error") < 0.0216);
    BOOST_TEST(h.largest("L") < 1e-12);
    BOOST_TEST(h.largest("energy") < 1e-9);
}

BOOST_AUTO_TEST_CASE(without_the_penalty_it_clumps) {
    auto model = hexagon(0.0);
    const History h =
        run<2>(model, rigid_rotation(0.1 / 8), {.method = "leapfrog", .dt = 0.3}, 4.0 * turn, 12.0);
    BOOST_TEST(h.smallest("closest_pair") < 0.5);
    BOOST_TEST(h.largest("L") < 1e-12);  // what does not depend on it is kept all the same
}

BOOST_AUTO_TEST_CASE(a_ball_in_space_about_a_skew_axis) {
    MaterialVectorModel<3> model(make_particles<3>(ball(), 1.0), PolynomialSolid{0.5, 0.5},
                                 {std::sqrt(2.0), 2.2, 1.0});
    BOOST_TEST(model.particles().size() == 249U);
    const Eigen::Vector3d omega = 0.03 * Eigen::Vector3d(1, 2, -0.5).normalized();
    const History h = run<3>(
        model, [&](const Point<3>& x) -> Point<3> { return omega.cross(x); },
        {.method = "leapfrog", .dt = 0.3}, effort(2000.0, 700.0, 60.0), 12.0);
    BOOST_TEST(h.largest("shape_error") < 0.02);
    BOOST_TEST(h.largest("p") < 1e-14);
    BOOST_TEST(h.largest("L") < 1e-13);
    BOOST_TEST(h.largest("energy") < 1e-4);
    BOOST_TEST_MESSAGE("ball: shape " << h.largest("shape_error") << ", dL/L " << h.largest("L")
                                      << ", dE/E " << h.largest("energy"));
}

/// Corner to corner and without adhesion: they part, whole, and ring with the rest of their energy.
BOOST_AUTO_TEST_CASE(two_hexagons_bounce) {
    Points<2> left = triangular_hexagon(5), right = left;
    left.row(0).array() -= 6.0;
    right.row(0).array() += 6.0;
    ParticleModel<2> model(
        joined<2>({make_particles<2>(left, 1.0), make_particles<2>(right, 1.0)}));
    const auto& law = model.add_term<MaterialVectors<2>>(
        PolynomialSolid::like(ElasticSolid::triangular_lattice()), MaterialVectorScheme{rho});
    model.add_term<Contact<2>>(ContactScheme{0.2, 1.0});
    BOOST_TEST(model.particles().bodies() == 2);
    const auto y0 = initial_state<2>(
        model, 1.0, 1.0, [](const Point<2>& x) { return Point<2>(x.x() < 0.0 ? 0.1 : -0.1, 0.0); });
    Motion<2> motion(model, y0, {.method = "rk4", .dt = 0.05});
    const auto start = measure_invariants(model, motion.y());
    motion.advance_to(100.0);
    const auto end = measure_invariants(model, motion.y());
    const auto n = static_cast<Eigen::Index>(model.particles().size() / 2);
    const auto v = motion.state().velocity();
    const double parting = v.row(0).tail(n).mean() - v.row(0).head(n).mean();
    BOOST_TEST_MESSAGE("they part with " << parting / 0.2 << " of the speed, dE/E "
                                         << end.energy / start.energy - 1.0 << ", dL "
                                         << end.angular_momentum.norm());
    BOOST_TEST(parting > 0.7 * 0.2);
    BOOST_TEST(std::abs(end.energy / start.energy - 1.0) < 1e-6);
    BOOST_TEST(end.momentum.norm() < 1e-12);
    BOOST_TEST(end.angular_momentum.norm() < 1e-7);
    BOOST_TEST(law.heat() == 0.0);
}

/// Particles with one or two neighbours left, whose F says nothing in some direction, do not flow: else
/// their vectors become infinite.
BOOST_AUTO_TEST_CASE(a_hexagon_spun_to_pieces) {
    const auto solid = PolynomialSolid::like(ElasticSolid::triangular_lattice());
    MaterialVectorModel<2> model(make_particles<2>(triangular_hexagon(8), 1.0),
                                 FlowingSolid{solid, 0.05, 0.05}, {rho});
    const auto y0 = initial_state<2>(model, 1.0, 1.0, rigid_rotation(0.8 / 8));
    Motion<2> motion(model, y0, {.method = "rk4", .dt = 0.05});
    const auto start = measure_invariants(model, motion.y());
    motion.advance_to(effort(150.0, 40.0));
    const auto end = measure_invariants(model, motion.y());
    const auto body = connected_parts<2>(motion.state().position(), 1.6, {});
    BOOST_TEST(*std::max_element(body.begin(), body.end()) > 30);
    BOOST_TEST(model.law.heat() > 0.1 * start.energy);
    BOOST_TEST(std::abs(end.energy / start.energy - 1.0) < 1e-6);
    BOOST_TEST(end.momentum.norm() < 1e-12);
    BOOST_TEST(std::abs(end.angular_momentum[0] / start.angular_momentum[0] - 1.0) < 1e-8);
}

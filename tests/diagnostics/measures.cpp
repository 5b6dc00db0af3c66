// SPDX-License-Identifier: GPL-3.0-or-later
#include "drop/roundness.hpp"
#include "support/random_state.hpp"
#include <spam/diagnostics/drift.hpp>
#include <spam/diagnostics/fits.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/outline.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

BOOST_AUTO_TEST_CASE(invariants_of_a_rigid_rotation) {
    BondedModel<2> model(make_particles<2>(triangular_hexagon(8), 1.0), {});
    const auto y = initial_state<2>(model, 1.0, 1.0, rigid_rotation(0.0125));
    const auto now = measure_invariants<2>(model, y);
    double inertia = 0.0;
    for (const auto& x : model.particles().reference_position.colwise()) inertia += x.squaredNorm();
    BOOST_TEST(now.mass == 217.0);
    BOOST_TEST(now.momentum.norm() < 1e-14);
    BOOST_TEST(now.angular_momentum[0] == 0.0125 * inertia, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(now.kinetic == 0.5 * 0.0125 * 0.0125 * inertia, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(now.energy == now.kinetic + now.internal);
    BOOST_TEST(angular_momentum_of_bodies(model, y)[0] == now.angular_momentum[0],
               boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(angular_momentum_in_space_is_a_vector) {
    BondedModel<3> model(jittered_particles<3>(4, 71), {});
    const auto y = random_state(model, 72);
    const ConstState<3> s(model.layout(), y);
    Eigen::Vector3d L = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < s.position().cols(); ++i)
        L += model.particles().mass[static_cast<std::size_t>(i)] *
             Eigen::Vector3d(s.position().col(i)).cross(Eigen::Vector3d(s.velocity().col(i)));
    BOOST_TEST((measure_invariants<3>(model, y).angular_momentum - L).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(angular_momenta_of_bodies_in_space_add_up) {
    auto particles = jittered_particles<3>(4, 73);
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.body[i] = static_cast<std::int32_t>(i % 3);
    BondedModel<3> model(particles, {});
    const auto y = random_state(model, 74);
    const auto of_bodies = angular_momentum_of_bodies(model, y);
    BOOST_TEST_REQUIRE(of_bodies.size() == 9U);
    const auto all = measure_invariants<3>(model, y).angular_momentum;
    for (std::size_t a = 0; a < 3; ++a) {
        BOOST_TEST(std::abs(of_bodies[a] + of_bodies[3 + a] + of_bodies[6 + a] -
                            all[static_cast<Eigen::Index>(a)]) < 1e-12);
        BOOST_TEST(std::abs(of_bodies[a] - of_bodies[3 + a]) > 1e-3);
    }
}

BOOST_AUTO_TEST_CASE(what_neighbours_exchange_at_a_mean_distance_and_speed) {
    BondedModel<2> model(make_particles<2>(triangular_hexagon(3), 1.5), {});
    auto y = initial_state<2>(model, 1.0, 1.0, rigid_rotation(0.1));
    State<2>(model.layout(), y).position() *= 1.01;
    const ConstState<2> s(model.layout(), y);
    const auto scales = measure_scales<2>(model, y);
    const auto tolerance = boost::test_tools::tolerance(1e-12);
    BOOST_TEST(scales.force == model.neighbour_forces(y));
    BOOST_TEST(scales.force > 0.1);
    BOOST_TEST(scales.torque == scales.force * s.position().colwise().norm().mean(), tolerance);
    BOOST_TEST(scales.power == scales.force * s.velocity().colwise().norm().mean(), tolerance);
    BOOST_TEST(scales.momentum == 1.5 * s.velocity().colwise().norm().sum(), tolerance);
}

BOOST_AUTO_TEST_CASE(shape_error_ignores_rigid_motion) {
    const Points<2> shape = triangular_hexagon(4);
    const Points<2> turned =
        (Eigen::Rotation2Dd(2.5).toRotationMatrix() * shape).colwise() + Eigen::Vector2d(3.0, -1.0);
    BOOST_TEST(shape_error<2>(shape, turned, 1.0) < 1e-14);
    const Points<2> stretched = 1.01 * turned;
    const double rms = std::sqrt(shape.colwise().squaredNorm().mean());
    BOOST_TEST(shape_error<2>(shape, stretched, 0.5) == 0.01 * rms / 0.5,
               boost::test_tools::tolerance(1e-12));
    Points<2> mirrored = shape;
    mirrored.row(0) *= -1.0;
    mirrored(0, 3) += 0.4;  // the hexagon itself is its own mirror image up to the particles' names
    BOOST_TEST(shape_error<2>(shape, mirrored, 1.0) > 0.5);
    const Points<3> cube = square_lattice<3>({3, 3, 3});
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Points<3> moved = turn * cube;
    BOOST_TEST(shape_error<3>(cube, moved, 1.0) < 1e-14);
}

BOOST_AUTO_TEST_CASE(closest_pairs) {
    Points<2> x = triangular_hexagon(4);
    BOOST_TEST(closest_pair<2>(x, 1.0, {}) == 1.0, boost::test_tools::tolerance(1e-12));
    x.col(7) = x.col(30) + Eigen::Vector2d(0.03, 0.04);
    BOOST_TEST(closest_pair<2>(x, 1.0, {}) == 0.05, boost::test_tools::tolerance(1e-10));
    Points<2> far(2, 2);
    far << 0, 300, 0, 400;
    BOOST_TEST(closest_pair<2>(far, 1.0, {}) == 500.0);
    BOOST_TEST(closest_pair<2>(far.leftCols(1), 1.0, {}) == HUGE_VAL);
    BOOST_TEST(closest_pair<2>(far, 1.0, Box<2>({6.0, 0.0})) == 400.0);  // 300 = 50 periods
    Points<1> edge(1, 3);
    edge << 0.1, 5.0, 9.95;
    BOOST_TEST(closest_pair<1>(edge, 1.0, Box<1>({10.0})) == 0.15,
               boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_outline_of_a_hexagon_is_its_outermost_ring) {
    Points<2> shape = triangular_hexagon(5);
    shape.colwise() += Eigen::Vector2d(30.0, -7.0);  // about its own centre
    const auto ring = outline(shape, 1.0);
    BOOST_TEST(ring.size() == 30U);
    for (std::size_t k = 0; k < ring.size(); ++k)  // neighbours along the rim follow each other
        BOOST_TEST((shape.col(ring[k]) - shape.col(ring[(k + 1) % ring.size()])).norm() == 1.0,
                   boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(history_answers_by_name) {
    History h({"t", "energy"});
    h.add({0.0, 2.0});
    h.add({1.0, 3.0});
    h.add({3.0, 1.0});
    BOOST_TEST(h.relative_drift("energy") == 0.5);
    BOOST_TEST(h.largest_change("energy") == 1.0);
    BOOST_TEST(h.at(2.0, "energy") == 2.0);
    BOOST_TEST(h.at(-1.0, "energy") == 2.0);
    BOOST_TEST(h.at(9.0, "energy") == 1.0);
    BOOST_CHECK_THROW(h.column("enrgy"), std::out_of_range);
    h.add({4.0, std::nan("")});
    h.add({5.0, 2.5});
    BOOST_TEST(std::isnan(h.largest_change("energy")));
}

BOOST_AUTO_TEST_CASE(drifts_are_judged_by_the_promise) {
    History h({"t", "dt", "mass", "momentum_x", "momentum_y", "angular_momentum", "kinetic",
               "internal", "energy"});
    h.add({0, 0.1, 10, 0, 0, 5.0, 1.0, 0.0, 1.0});
    h.add({1, 0.1, 10, 0, 1e-9, 4.0, 0.9, 0.1 + 1e-8, 1.0 + 1e-8});
    DriftScales sizes;
    sizes.momentum = 10.0;
    sizes.angular_momentum = 5.0;
    const auto drifts = measure_drifts(h, Scheme{}.promises(2), sizes, 1e-6);
    BOOST_TEST(drifts.size() == 4U);
    BOOST_TEST(drifts[0].kept());
    BOOST_TEST(!drifts[1].kept());  // momentum is promised exactly
    BOOST_TEST(drifts[1].change == 1e-10, boost::test_tools::tolerance(1e-10));
    BOOST_TEST(drifts[2].kept());  // not promised
    BOOST_TEST(drifts[2].change == 0.2, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(drifts[3].kept());  // to integrator error
    Promises strict = Scheme{}.promises(2);
    strict.angular_momentum = Promise::integrator_error;
    BOOST_TEST(!measure_drifts(h, strict, sizes, 1e-6)[2].kept());
}

/// A block that falls, and is pushed: its momentum and energy change by what it is given, and a little more.
BOOST_AUTO_TEST_CASE(what_is_watched_is_less_what_was_given) {
    History h({"t",
               "dt",
               "mass",
               "momentum_x",
               "momentum_y",
               "momentum_z",
               "angular_momentum_x",
               "angular_momentum_y",
               "angular_momentum_z",
               "kinetic",
               "internal",
               "energy",
               "work",
               "heat",
               "impulse_x",
               "impulse_y",
               "impulse_z",
               "angular_impulse_x",
               "angular_impulse_y",
               "angular_impulse_z"});
    h.add({0, 1, 4, 3, 2, 0, 7, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0});
    h.add({1, 1, 4, 3, 1, 0, 9, 0, 5, 3, 1, 4.5, 2, 1, 0, -1.25, 0, 2, 0, 4});
    const auto all = watched_changes(h);
    std::vector<std::string> names;
    std::vector<double> last;
    for (const WatchedChange& one : all) {
        names.push_back(one.name());
        last.push_back(one.change.back());
        BOOST_TEST(one.change.front() == 0.0);
    }
    const std::vector<std::string> expected{"mass",
                                            "momentum x less impulse",
                                            "momentum y less impulse",
                                            "momentum z less impulse",
                                            "angular momentum x less angular impulse",
                                            "angular momentum y less angular impulse",
                                            "angular momentum z less angular impulse",
                                            "energy less work and heat"};
    BOOST_TEST(names == expected, boost::test_tools::per_element());
    const std::vector<double> changes{0, 0, 0.25, 0, 0, 0, 1, 0.5};
    BOOST_TEST(last == changes, boost::test_tools::per_element());
    BOOST_TEST(all[2].name(false) == "momentum less impulse");
    DriftScales one;
    one.momentum = one.angular_momentum = 1.0;
    const auto drifts = measure_drifts(h, Scheme{}.promises(3), one, 1e-6);  // the same numbers
    BOOST_TEST(drifts[1].change == 0.25);
    BOOST_TEST(drifts[2].change == 1.0);
    BOOST_TEST(drifts[3].change == 0.5 / 3.0);  // by the largest kinetic energy
}

namespace {

/// Of a run whose energy begins at E0 and changes by 1e-7 while its kinetic energy reaches K.
Drift energy_drift(double E0, double K, const DriftScales& scales) {
    History h({"t", "dt", "mass", "momentum_x", "kinetic", "internal", "energy"});
    h.add({0, 0.1, 10, 0, 0.0, E0, E0});
    h.add({1, 0.1, 10, 0, K, E0 - K + 1e-7, E0 + 1e-7});
    return measure_drifts(h, Scheme{}.promises(1), scales, 1e-6).back();
}

}  // namespace

/// Beside what has overflowed nothing would count as a change.
BOOST_AUTO_TEST_CASE(a_scale_that_is_not_finite_keeps_nothing) {
    const double infinite = std::numeric_limits<double>::infinity();
    BOOST_TEST(!energy_drift(infinite, 1.0, {}).kept());
    BOOST_TEST(!energy_drift(0.0, infinite, {}).kept());
    DriftScales worked;
    worked.work = infinite;
    BOOST_TEST(!energy_drift(0.0, 1.0, worked).kept());
    BOOST_TEST(std::isinf(energy_drift(0.0, infinite, {}).change));
    BOOST_TEST(energy_drift(0.0, 1.0, {}).kept());
}

/// Of a symplectic method what dt^2 makes of accelerations, and no less than of others.
BOOST_AUTO_TEST_CASE(a_swing_that_goes_with_the_step_is_allowed) {
    DriftScales swinging;
    swinging.add_swing(0.1, 2.5e-5);
    swinging.add_swing(0.1, 1e-5);
    BOOST_TEST(swinging.swing == 5e-7, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(energy_drift(0.0, 0.01, swinging).limit == 5e-5,
               boost::test_tools::tolerance(1e-12));
    BOOST_TEST(energy_drift(0.0, 0.01, swinging).kept());
    BOOST_TEST(!energy_drift(0.0, 0.01, {}).kept());
    swinging.swing = 0.5e-7;
    BOOST_TEST(!energy_drift(0.0, 0.01, swinging).kept());
    BOOST_TEST(energy_drift(0.0, 100.0, swinging).limit == 1e-6);
    swinging.add_swing(0.1, std::numeric_limits<double>::infinity());
    BOOST_TEST(swinging.swing == 0.5e-7);
}

BOOST_AUTO_TEST_CASE(what_energies_and_small_momenta_are_compared_with) {
    // The start, the largest kinetic energy where that is larger, or a 1e-15th of the work done.
    const auto tolerance = boost::test_tools::tolerance(1e-7);
    BOOST_TEST(energy_drift(-8.0, 2.0, {}).scale == 8.0);
    BOOST_TEST(energy_drift(-8.0, 2.0, {}).change == 1e-7 / 8.0, tolerance);
    BOOST_TEST(energy_drift(0.0, 0.5, {}).change == 2e-7, tolerance);
    BOOST_TEST(energy_drift(0.0, 0.5, {}).kept());
    BOOST_TEST(!energy_drift(0.0, 0.05, {}).kept());
    DriftScales worked;
    worked.work = 1e9;  // of which rounding leaves up to 1e-6
    BOOST_TEST(energy_drift(0.0, 0.05, worked).change * 1e-15 * 1e9 == 1e-6 * 1e-7, tolerance);
    BOOST_TEST(energy_drift(0.0, 0.05, worked).kept());
    worked.work = 0.99e8;
    BOOST_TEST(!energy_drift(0.0, 0.05, worked).kept());

    DriftScales scales;
    scales.add(1.0, {.momentum = 3.0, .angular_momentum = 7.0, .force = 2.0, .torque = 4.0});
    scales.add(3.0, {.momentum = 1.0, .angular_momentum = 8.0, .force = 4.0, .power = 1.0});
    BOOST_TEST(scales.momentum == 3.0);
    BOOST_TEST(scales.angular_momentum == 8.0);
    BOOST_TEST(scales.impulse == 6.0);
    BOOST_TEST(scales.torque == 4.0);
    BOOST_TEST(scales.work == 1.0);
    BOOST_TEST(measure_drifts(History({"t", "mass"}), {}, scales, 1e-6).empty());
}

BOOST_AUTO_TEST_CASE(fits_recover_lines_and_orders) {
    const std::vector<double> x{0, 1, 2, 3, 4}, y{1.0, 3.0, 5.0, 7.0, 9.0};
    BOOST_TEST(fit_line(x, y).slope == 2.0, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(fit_line(x, y).intercept == 1.0, boost::test_tools::tolerance(1e-14));
    const std::vector<double> steps{0.1, 0.05, 0.025}, errors{3e-4, 3e-4 / 16, 3e-4 / 256};
    BOOST_TEST(observed_order(steps, errors) == 4.0, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_body_survives_until_its_shape_or_a_pair_is_lost) {
    const auto survived = [](double error, double pair) {
        History history({"t", "shape_error", "closest_pair"});
        history.add({0.0, 0.0, 1.0});
        history.add({2.0, 0.49, 0.31});
        history.add({3.0, error, pair});
        history.add({5.0, 0.1, 0.9});
        return survival(history);
    };
    BOOST_TEST(survived(0.49, 0.31).t == 5.0);
    BOOST_TEST(survived(0.49, 0.31).whole);
    BOOST_TEST(survived(0.5, 0.31).t == 3.0);
    BOOST_TEST(survived(0.5, 0.31).end == "deformed");
    BOOST_TEST(survived(0.49, 0.3).t == 3.0);
    BOOST_TEST(survived(0.49, 0.3).end == "clumped");
    BOOST_TEST(!survived(0.6, 0.2).whole);
    BOOST_TEST(survived(0.6, 0.2).end == "clumped and deformed");
    BOOST_TEST(survived(std::nan(""), 0.9).t == 3.0);
}

BOOST_AUTO_TEST_CASE(how_far_a_body_is_from_round) {
    // Of n x n evenly spaced sites, with <x^2> and <x^4> of n whole numbers about their mean.
    for (const int n : {2, 5, 40}) {
        const double x2 = (n * n - 1) / 12.0, x4 = x2 * (3 * n * n - 7) / 20.0;
        const std::vector<double> mass(std::size_t(n * n), 2.0);
        BOOST_TEST(fourfold_moment(square_lattice<2>({n, n}), mass) ==
                       std::abs(x4 - 3.0 * x2 * x2) / (x4 + x2 * x2),
                   boost::test_tools::tolerance(1e-13));
        if (n == 40)
            BOOST_TEST(std::abs(fourfold_moment(square_lattice<2>({n, n}), mass) - 3.0 / 7.0) <
                       1e-3);
    }
    // Six-fold symmetry has no fourfold part; nor has a ring of unequal masses that alternate so.
    const Points<2> hexagon = triangular_hexagon(5);
    BOOST_TEST(fourfold_moment(hexagon, std::vector<double>(std::size_t(hexagon.cols()), 1.0)) <
               1e-14);
    Points<2> ring(2, 16);
    std::vector<double> mass(16);
    for (int k = 0; k < 16; ++k) {
        const double angle = k * std::numbers::pi / 8.0;
        ring.col(k) << std::cos(angle) + 7.0, std::sin(angle) - 3.0;  // wherever it lies
        mass[std::size_t(k)] = 1.0 + 0.5 * std::cos(4.0 * angle);
    }
    BOOST_TEST(fourfold_moment(ring, std::vector<double>(16, 1.0)) < 1e-13);
    BOOST_TEST(fourfold_moment(ring, mass) == 0.25, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(clumped_are_those_with_a_near_neighbour) {
    Points<2> x = square_lattice<2>({10, 10});
    const Box<2> box({10.0, 10.0});
    BOOST_TEST(clumped_fraction<2>(x, 0.4, box) == 0.0);
    BOOST_TEST(clumped_fraction<2>(x, 1.01, box) == 1.0);
    x.col(37) = x.col(36) + Point<2>(0.3, 0.2);  // two at one place
    x.col(0) = Point<2>(9.8, 8.8);   // near the one at (0, 9), across both borders: alone
    x.col(90) = Point<2>(0.1, 9.0);  // which comes nearer
    BOOST_TEST(clumped_fraction<2>(x, 0.4, box) == 0.04, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(clumped_fraction<2>(x, 0.4, {}) == 0.02, boost::test_tools::tolerance(1e-14));
}

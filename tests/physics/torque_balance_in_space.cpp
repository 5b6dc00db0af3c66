// SPDX-License-Identifier: GPL-3.0-or-later
// Balanced torques in space: of fragments at random, and of a flat body the law of the plane.
#include "support/random_state.hpp"
#include <spam/material/elastic_solid.hpp>
#include <spam/physics/torque_balance_in_space.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

using Torques = std::vector<Vec<3>>;

double factor(const Vec<3>& torque, const Vec<3>& theta) {
    return exponential(-dot(theta, TorqueDirection<double>(torque).n));
}

TorqueMoments moments(const Torques& torques, const Vec<3>& theta) {
    TorqueMoments m;
    for (const Vec<3>& T : torques) {
        const TorqueDirection<double> direction(T);
        const Vec<3> scaled = factor(T, theta) * T;
        m.torque += scaled;
        for (int a = 0; a < 3; ++a)
            for (int b = a; b < 3; ++b) m.spread(a, b) += scaled[a] * direction.n[b];
    }
    return m;
}

struct Balanced {
    Vec<3> theta;
    double residual, size;  ///< |sum s T| and sum s |T|, by sum |T|
    int sums = 1;
};
Balanced balanced(const Torques& torques, const Vec<3>& X = {}) {
    TorqueBalance search;
    search.begin(moments(torques, {}), X);
    int sums = 1;
    for (; !search.done(); ++sums) search.next(moments(torques, search.theta()));
    const TorqueMoments end = moments(torques, search.theta());
    const auto trace = [](const TorqueMoments& m) {
        return m.spread(0, 0) + m.spread(1, 1) + m.spread(2, 2);
    };
    const Vec<3> rest = end.torque + X;
    const double all = trace(moments(torques, {}));
    return {search.theta(), std::sqrt(dot(rest, rest)) / all, trace(end) / all, sums};
}

/// Torques of random pair forces among particles at random places.
Torques fragment(int particles, std::mt19937_64& random) {
    std::normal_distribution<double> g;
    std::vector<Vec<3>> x(static_cast<std::size_t>(particles));
    for (auto& place : x) place = {{g(random), g(random), g(random)}};
    Torques torques;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = i + 1; j < x.size(); ++j)
            torques.push_back(cross(x[i] - x[j], Vec<3>{{g(random), g(random), g(random)}}));
    return torques;
}

}  // namespace

BOOST_AUTO_TEST_CASE(of_random_fragments_no_torque_is_left_and_no_force_explodes) {
    std::mt19937_64 random(5);
    double worst = 0.0, largest = 0.0, sums = 0.0;
    int bad = 0, free = 0;
    for (int k = 0; k < 100000; ++k) {
        const Torques torques = fragment(2 + k % 7, random);
        const Balanced b = balanced(torques);
        worst = std::max(worst, b.residual);
        largest = std::max(largest, b.size);
        sums += b.sums / 1e5;
        for (const Vec<3>& T : torques) bad += std::isfinite(factor(T, b.theta)) ? 0 : 1;
        const TorqueMoments before = moments(torques, {});
        free += std::sqrt(dot(before.torque, before.torque)) > 1e-2 ? 1 : 0;
    }
    BOOST_TEST(worst < 1e-12);
    BOOST_TEST(largest < 1.0 + 1e-14);
    BOOST_TEST(bad == 0);
    BOOST_TEST(free > 99000);  // before
    BOOST_TEST(sums < 30.0);
}

BOOST_AUTO_TEST_CASE(factors_are_those_of_the_least_sum) {
    // On the constraint every other s has a larger sum, and the sum is stationary at s.
    std::mt19937_64 random(6);
    std::normal_distribution<double> g;
    const Torques torques = fragment(9, random);
    const Vec<3> X{{0.3, -0.2, 0.5}};
    const Balanced b = balanced(torques, X);
    BOOST_TEST(b.residual < 1e-13);
    const auto n = static_cast<Eigen::Index>(torques.size());
    Eigen::MatrixXd A(3, n);
    Eigen::VectorXd s(n), size(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const Vec<3>& T = torques[static_cast<std::size_t>(k)];
        A.col(k) << T[0], T[1], T[2];
        s[k] = factor(T, b.theta);
        size[k] = A.col(k).norm();
    }
    const auto sum = [&](const Eigen::VectorXd& at) {
        return (size.array() * (at.array() * at.array().log() - at.array())).sum();
    };
    for (int k = 0; k < 20; ++k) {
        Eigen::VectorXd change(n);
        for (auto& c : change) c = g(random);
        change -= A.transpose() * (A * A.transpose()).ldlt().solve(A * change);
        change *= 1e-3 * s.minCoeff() / change.cwiseAbs().maxCoeff();
        BOOST_TEST(sum(s + change) > sum(s));
        BOOST_TEST(std::abs(sum(s + change) - sum(s - change)) < 1e-2 * (sum(s + change) - sum(s)));
    }
}

BOOST_AUTO_TEST_CASE(a_rate_that_no_torques_balance_is_told) {
    const Torques torques{{{1.0, 0.0, 0.0}}, {{0.0, 1.0, 0.0}}};
    BOOST_TEST(balanced(torques, {{-0.5, -0.7, 0.0}}).residual < 1e-13);
    TorqueBalance search;
    const Vec<3> X{{0.5, 0.0, 0.1}};
    search.begin(moments(torques, {}), X);
    while (!search.done()) search.next(moments(torques, search.theta()));
    BOOST_TEST(search.residual() > 0.1);
    for (const Vec<3>& T : torques) BOOST_TEST(std::isfinite(factor(T, search.theta())));
}

namespace {

const ElasticSolid solid{0.7, 0.4};

/// Rates of a plane body's velocities by the law of the plane, and of the same body in space, turned by Q.
double difference_in_space(const Scheme& scheme, const Eigen::Matrix3d& Q) {
    // Both with a weight that is made for space, or the factors of normalization would differ.
    const auto flat = jittered_particles<2>(8, 3);
    Points<3> points = Points<3>::Zero(3, flat.reference_position.cols());
    points.topRows<2>() = flat.reference_position;
    points = (Q * points).eval();
    auto particles = make_particles<3>(points, 1.0);
    particles.mass = flat.mass;
    SmoothParticleModel<2> plane(flat, solid, scheme);
    SmoothParticleModel<3> space(particles, solid, scheme);
    const auto y = random_state<2>(plane, 4);
    std::vector<double> z(space.layout().size(), 0.0);
    const ConstState<2> from(plane.layout(), y);
    const State<3> to(space.layout(), z);
    // Lucy's weight in space is that of the plane times a number: densities and stresses make up for it.
    const double ratio = std::sqrt((105.0 / (16.0 * std::numbers::pi * std::pow(scheme.range, 3))) /
                                   (5.0 / (std::numbers::pi * std::pow(scheme.range, 2))));
    to.position() = points;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
        Eigen::Vector3d v = Eigen::Vector3d::Zero();
        v.head<2>() = from.velocity().col(i);
        to.velocity().col(i) = Q * v;
        to.density()(0, i) = ratio * from.density()(0, i);
        Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
        t(0, 0) = from.stress()(0, i);
        t(1, 1) = from.stress()(1, i);
        t(0, 1) = t(1, 0) = from.stress()(2, i);
        t = (Q * t * Q.transpose()).eval();
        for (int a = 0; a < 3; ++a)
            for (int b = a; b < 3; ++b) to.stress()(symmetric_index(3, a, b), i) = t(a, b);
    }
    const auto y_dot = rates_of(plane, y), z_dot = rates_of(space, z);
    const ConstState<2> in_plane(plane.layout(), y_dot);
    const ConstState<3> in_space(space.layout(), z_dot);
    double worst = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
        Eigen::Vector3d a = Eigen::Vector3d::Zero();
        a.head<2>() = in_plane.velocity().col(i);
        worst = std::max(worst, (in_space.velocity().col(i) - Q * a).norm());
    }
    return worst / in_plane.velocity().colwise().norm().maxCoeff();
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_flat_body_in_space_obeys_the_law_of_the_plane) {
    const Eigen::Matrix3d turned =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
    Eigen::Matrix3d mirrored = turned;
    mirrored.col(0) *= -1.0;
    for (const auto law :
         {AngularMomentum::torque_pair, AngularMomentum::torque_particle, AngularMomentum::gauss}) {
        const Scheme scheme{.angular_momentum = law, .range = 2.6};
        BOOST_TEST_CONTEXT(scheme.describe()) {
            BOOST_TEST(difference_in_space(scheme, Eigen::Matrix3d::Identity()) < 1e-12);
            BOOST_TEST(difference_in_space(scheme, turned) < 1e-11);
            BOOST_TEST(difference_in_space(scheme, mirrored) < 1e-11);
        }
    }
}

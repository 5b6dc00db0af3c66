// SPDX-License-Identifier: GPL-3.0-or-later
// What the reflection of an approaching pair keeps, and that laws a little different do not; which
// pairs a state arms.
#include <spam/core/error.hpp>
#include <spam/physics/closest_approach.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace spam;

namespace {

/// The true law with something wrong.
enum class Mutation { none, along_v, reduced_mass, half, one_only };

template <int Dim>
void reflect(Mutation mutation, double m_i, double m_j, const Point<Dim>& r, Point<Dim>& v_i,
             Point<Dim>& v_j) {
    if (mutation == Mutation::none) {
        BOOST_TEST(ElasticReflection<Dim>()(m_i, m_j, r, v_i, v_j));
        return;
    }
    const Point<Dim> v = v_i - v_j;
    double mu = m_i * m_j / (m_i + m_j);
    if (mutation == Mutation::reduced_mass) mu = 0.25 * (m_i + m_j);
    if (mutation == Mutation::half) mu *= 0.5;
    Point<Dim> impulse = (-2.0 * mu * v.dot(r) / r.squaredNorm()) * r;
    if (mutation == Mutation::along_v) impulse = -2.0 * mu * v;
    v_i += impulse / m_i;
    if (mutation != Mutation::one_only) v_j -= impulse / m_j;
}

/// Largest relative violations over random approaching pairs.
struct Violations {
    double momentum = 0.0, angular_momentum = 0.0, energy = 0.0, radial = 0.0, tangential = 0.0;
};

template <int Dim>
Violations violations(Mutation mutation) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> g;
    Violations worst;
    for (int trial = 0; trial < 200; ++trial) {
        Point<Dim> x_i, x_j, v_i, v_j;
        for (auto* p : {&x_i, &x_j, &v_i, &v_j})
            for (double& c : p->reshaped()) c = g(random);
        const double m_i = std::exp(g(random)), m_j = std::exp(g(random));
        const Point<Dim> r = x_i - x_j;
        if ((v_i - v_j).dot(r) > 0.0) std::swap(v_i, v_j);
        const Point<Dim> w_i = v_i, w_j = v_j;
        reflect<Dim>(mutation, m_i, m_j, r, v_i, v_j);
        const double size = m_i * w_i.norm() + m_j * w_j.norm();
        const auto keep = [](double& most, double x) { most = std::max(most, std::abs(x)); };
        keep(worst.momentum, (m_i * (v_i - w_i) + m_j * (v_j - w_j)).norm() / size);
        for (int a = 0; a < Dim; ++a)
            for (int b = a + 1; b < Dim; ++b) {
                const auto moment = [&](const Point<Dim>& x, const Point<Dim>& p) {
                    return x[a] * p[b] - x[b] * p[a];
                };
                keep(worst.angular_momentum,
                     (m_i * moment(x_i, v_i - w_i) + m_j * moment(x_j, v_j - w_j)) /
                         (size * (x_i.norm() + x_j.norm())));
            }
        const double before = m_i * w_i.squaredNorm() + m_j * w_j.squaredNorm();
        keep(worst.energy, (m_i * v_i.squaredNorm() + m_j * v_j.squaredNorm() - before) / before);
        const Point<Dim> v = v_i - v_j, w = w_i - w_j, n = r / r.norm();
        keep(worst.radial, (v.dot(n) + w.dot(n)) / w.norm());
        keep(worst.tangential, ((v - v.dot(n) * n) - (w - w.dot(n) * n)).norm() / w.norm());
    }
    return worst;
}

template <int Dim>
void check_reflection() {
    const auto kept = violations<Dim>(Mutation::none);
    for (const double v :
         {kept.momentum, kept.angular_momentum, kept.energy, kept.radial, kept.tangential})
        BOOST_TEST(v < 1e-14);
    if constexpr (Dim > 1) {
        BOOST_TEST(violations<Dim>(Mutation::along_v).angular_momentum > 1e-3);
        BOOST_TEST(violations<Dim>(Mutation::along_v).tangential > 1e-3);
    }
    BOOST_TEST(violations<Dim>(Mutation::reduced_mass).energy > 1e-3);
    BOOST_TEST(violations<Dim>(Mutation::half).energy > 1e-3);
    BOOST_TEST(violations<Dim>(Mutation::half).radial > 1e-3);
    BOOST_TEST(violations<Dim>(Mutation::one_only).momentum > 1e-3);
}

/// Two particles on a line through a plane: x of the second, v of the first.
struct Two {
    Points<2> x{{0.0, 0.0}, {0.0, 0.0}}, v{{0.0, 0.0}, {0.0, 0.0}};
    Two(double distance, double speed) {
        x(0, 1) = distance;
        v(0, 0) = speed;
    }
};

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

BOOST_AUTO_TEST_CASE(a_reflection_keeps_momentum_angular_momentum_and_energy) {
    check_reflection<1>();
    check_reflection<2>();
    check_reflection<3>();
}

BOOST_AUTO_TEST_CASE(separating_pairs_are_not_reflected) {
    Point<2> v_i(0.3, 1.0), v_j(-0.2, 0.0);
    BOOST_TEST(!ElasticReflection<2>()(1.0, 1.0, Point<2>(1.0, 0.0), v_i, v_j));
    BOOST_TEST(v_i == Point<2>(0.3, 1.0));
}

BOOST_AUTO_TEST_CASE(a_pair_is_armed_where_it_is_outside) {
    ClosestApproach<2> approach({1.0, 1.0}, {}, 0.5, true);
    const Two outside(0.54, 0.1);
    approach.arm(0.0, outside.x, outside.v);
    BOOST_TEST(approach.distance(0.0, outside.x, outside.v) == 0.0416,
               boost::test_tools::tolerance(1e-12));
    const Two nearer(0.49, 0.1);
    BOOST_TEST(approach.distance(1.1, nearer.x, nearer.v) < 0.0);
    approach.arm(1.1, nearer.x, nearer.v);
    BOOST_TEST(approach.distance(1.1, nearer.x, nearer.v) == infinity);
    approach.arm(2.0, outside.x, outside.v);  // out again
    BOOST_TEST(approach.distance(2.0, outside.x, outside.v) > 0.0);
    BOOST_TEST(approach.distance(2.0, outside.x, outside.v) < 1.0);
}

BOOST_AUTO_TEST_CASE(a_pair_that_comes_and_goes_within_a_step_is_seen) {
    ClosestApproach<2> moves_with_v({1.0, 1.0}, {}, 0.5, true),
        averaged({1.0, 1.0}, {}, 0.5, false);
    // It passes at a distance of 0.49999, from 0.01 on one side to as far on the other.
    Points<2> before{{0.0, 0.01}, {0.0, 0.49999}}, after{{0.0, -0.01}, {0.0, 0.49999}},
        v{{0.0, -0.2}, {0.0, 0.0}};
    moves_with_v.arm(0.0, before, v);
    averaged.arm(0.0, before, v);
    BOOST_TEST(moves_with_v.distance(0.1, after, v) == 0.49999 * 0.49999 - 0.25,
               boost::test_tools::tolerance(1e-9));
    BOOST_TEST(averaged.distance(0.1, after, v) > 0.0);  // where only ends count
}

BOOST_AUTO_TEST_CASE(a_pair_moved_by_an_averaged_velocity_passes_the_surface_once) {
    ClosestApproach<2> approach({1.0, 1.0}, {}, 0.5, false);
    const double at_surface = 0.5 * (1.0 + 1e-13);
    Two two(0.54, 0.1), touching(at_surface, 0.1);
    approach.arm(0.0, two.x, two.v);
    BOOST_TEST(approach.reflect(touching.x, touching.v) == 1U);
    BOOST_TEST(touching.v(0, 1) == 0.1);
    approach.arm(1.0, touching.x, touching.v);
    BOOST_TEST(approach.distance(1.0, touching.x, touching.v) == infinity);
    Two approaching(at_surface, 0.1);  // once v approaches it counts again
    approach.arm(2.0, approaching.x, approaching.v);
    BOOST_TEST(approach.distance(2.0, approaching.x, approaching.v) < 1e-10);
}

BOOST_AUTO_TEST_CASE(a_step_that_outruns_the_list_is_refused) {
    ClosestApproach<2> approach({1.0, 1.0}, {}, 0.5, true);
    const Two far(30.0, 100.0), past(-30.0, 100.0);
    approach.arm(0.0, far.x, far.v);
    // It has gone through the other one, which no list for the beginning can know.
    BOOST_TEST(approach.distance(0.6, past.x, past.v) == -infinity);
    BOOST_CHECK_THROW(ClosestApproach<2>({1.0}, Box<2>({1.0, 0.0}), 0.5, true), InputError);
}

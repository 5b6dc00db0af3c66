// SPDX-License-Identifier: GPL-3.0-or-later
// F_ij = -F_ji bit for bit, and the balance of pair torques.
#include <spam/kernel/general_weight.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/box.hpp>
#include <spam/physics/gauss_constraint.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/physics/viscosity.hpp>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace spam;

namespace {

template <int Dim>
TransportRecord<Dim> random_record(std::mt19937_64& random) {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    TransportRecord<Dim> r;
    for (int a = 0; a < Dim; ++a) {
        r.x[a] = u(random);
        r.v[a] = u(random);
    }
    r.m = 1.0 + 0.3 * u(random);
    r.rho = 1.0 + 0.3 * u(random);
    for (double& s : r.A.c) s = u(random);
    r.negative_factor = 1.0 + 0.3 * u(random);
    r.positive_factor = 1.0 / r.negative_factor;
    return r;
}

/// How often f(i, j) differs from -f(j, i) in any bit, of 10000 random pairs.
template <int Dim, class Force, class Weight = Lucy<Dim>>
int asymmetric_pairs(const Force& force, const Weight& w = Weight(3.0)) {
    std::mt19937_64 random(31);
    int count = 0;
    for (int k = 0; k < 10000; ++k) {
        const auto i = random_record<Dim>(random), j = random_record<Dim>(random);
        const auto ij = make_pair<Dim, double>(w, separation(i.x, j.x), i, j);
        const auto ji = make_pair<Dim, double>(w, separation(j.x, i.x), j, i);
        const auto f_ij = force(ij, i, j), f_ji = force(ji, j, i);
        bool same = true;
        for (int a = 0; a < Dim; ++a) same = same && f_ij[a] == -f_ji[a];
        count += same ? 0 : 1;
    }
    return count;
}

const auto stress = [](const auto& pair, const auto& i, const auto& j) {
    return stress_force(pair, i, j);
};
const auto balanced = [](const auto& pair, const auto& i, const auto& j) {
    return scale_torque(pair, i, j, stress_force(pair, i, j));
};
const auto viscous = [](const auto& pair, const auto& i, const auto& j) {
    return ViscousForce<2, ArithmeticMean>{{0.4, 1.1, 1.3}}.force(pair, i, j);
};
auto viscous_with(MeanDensityKind kind) {
    return [kind](const auto& pair, const auto& i, const auto& j) {
        return ViscousForce<2, EitherMean>::with({kind, {0.4, 1.1, 1.3}}).force(pair, i, j);
    };
}
// sigma/rho^2 of one particle only: momentum would drift.
const auto one_sided = [](const auto& pair, const auto& i, const auto&) {
    return i.A * pair.grad_w;
};
}  // namespace

BOOST_AUTO_TEST_CASE(forces_are_antisymmetric_bit_for_bit) {
    BOOST_TEST(asymmetric_pairs<1>(stress) == 0);
    BOOST_TEST(asymmetric_pairs<2>(stress) == 0);
    BOOST_TEST(asymmetric_pairs<3>(stress) == 0);
    BOOST_TEST(asymmetric_pairs<2>(balanced) == 0);
    BOOST_TEST(asymmetric_pairs<2>(viscous) == 0);
    BOOST_TEST(asymmetric_pairs<2>(one_sided) > 9000);
}

BOOST_AUTO_TEST_CASE(forces_chosen_at_run_time_are_antisymmetric_bit_for_bit) {
    for (const Kernel kernel : all_kernels()) {
        const GeneralWeight<2> w(kernel, 3.0);
        BOOST_TEST(asymmetric_pairs<2>(stress, w) == 0);
        BOOST_TEST(asymmetric_pairs<2>(balanced, w) == 0);
        BOOST_TEST(asymmetric_pairs<2>(viscous_with(MeanDensityKind::arithmetic), w) == 0);
        BOOST_TEST(asymmetric_pairs<2>(viscous_with(MeanDensityKind::geometric), w) == 0);
        BOOST_TEST(asymmetric_pairs<2>(one_sided, w) > 9000);
    }
}

BOOST_AUTO_TEST_CASE(either_mean_is_one_or_the_other) {
    std::mt19937_64 random(35);
    std::uniform_real_distribution<double> u(0.2, 3.0);
    const auto arithmetic = MeanDensityKind::arithmetic, geometric = MeanDensityKind::geometric;
    const auto over = [](MeanDensityKind kind, double number, double a, double b) {
        return EitherMean::of(kind).over(number, EitherMean::number(kind, a),
                                         EitherMean::number(kind, b));
    };
    for (int k = 0; k < 1000; ++k) {
        const double m = u(random), a = u(random), b = u(random);
        const double expected = ArithmeticMean::factor * ArithmeticMean::over(m, a, b);
        BOOST_TEST(over(arithmetic, m, a, b) == expected);
        BOOST_TEST(over(geometric, m, a, b) == m / std::sqrt(a * b),
                   boost::test_tools::tolerance(1e-15));
        BOOST_TEST(std::abs(over(geometric, m, a, b) - expected) > 0.0);
    }
}

BOOST_AUTO_TEST_CASE(viscosity_is_central_and_only_resists_approach) {
    std::mt19937_64 random(32);
    int approaching = 0;
    for (int k = 0; k < 1000; ++k) {
        const auto i = random_record<2>(random), j = random_record<2>(random);
        const auto pair = make_pair<2, double>(Lucy<2>(3.0), separation(i.x, j.x), i, j);
        const auto extra = viscous(pair, i, j);
        BOOST_TEST(std::abs(cross(extra, pair.r_ji)) < 1e-15);
        if (dot(pair.v_ji, pair.r_ji) < 0.0) {
            ++approaching;
            BOOST_TEST(dot(extra, pair.r_ji) < 0.0);  // i is pushed away from j
            BOOST_TEST(dot(extra, pair.v_ji) > 0.0);  // it heats
        } else {
            BOOST_TEST(dot(extra, extra) == 0.0);
        }
    }
    BOOST_TEST(approaching > 400);
}

BOOST_AUTO_TEST_CASE(one_particles_factor_alone_is_not_antisymmetric) {
    // Matters where two bodies touch.
    const auto wrong = [](const auto& pair, const auto& i, const auto& j) {
        return scale_torque(pair, i, i, stress_force(pair, i, j));
    };
    BOOST_TEST(asymmetric_pairs<2>(wrong) > 1000);
}

BOOST_AUTO_TEST_CASE(scaling_multiplies_the_torque_and_leaves_the_radial_force) {
    std::mt19937_64 random(33);
    for (int k = 0; k < 1000; ++k) {
        auto i = random_record<2>(random), j = random_record<2>(random);
        j.negative_factor = i.negative_factor;
        j.positive_factor = i.positive_factor;
        const auto pair = make_pair<2, double>(Lucy<2>(3.0), separation(i.x, j.x), i, j);
        const auto before = stress_force(pair, i, j), after = scale_torque(pair, i, j, before);
        const double torque = cross(before, pair.r_ji);
        const double s = torque < 0.0 ? i.negative_factor : i.positive_factor;
        BOOST_TEST(std::abs(cross(after, pair.r_ji) - s * torque) < 1e-14);
        BOOST_TEST(std::abs(dot(pair.r_ji, after) - dot(pair.r_ji, before)) < 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(balance_solves_its_equation) {
    for (const double X : {0.0, 1e-12, 0.3, -0.3, 5.0, -5.0, 1e3, -1e3})
        for (const double P : {1e-20, 0.1, 2.0})
            for (const double M : {1e-20, 0.1, 2.0}) {
                const TorqueScale s = torque_balance(P, M, X);
                BOOST_TEST(s.negative > 0.0);
                BOOST_TEST(std::abs(s.negative * s.positive - 1.0) < 1e-15);
                const double size = P * s.positive + M * s.negative + std::abs(X);
                BOOST_TEST(std::abs(P * s.positive - M * s.negative + X) < 1e-14 * size);
            }
}

BOOST_AUTO_TEST_CASE(torques_of_one_sign_are_scaled_away) {
    BOOST_TEST(torque_balance(0.0, 1.0, 0.0).negative == 0.0);
    BOOST_TEST(torque_balance(1.0, 0.0, 0.0).positive == 0.0);
    BOOST_TEST(torque_balance(1.0, 1e-20, 0.0).positive < 1e-9);  // and so is what is nearly so
    BOOST_TEST(torque_balance(2.0, 0.0, -0.5).positive == 0.25);  // or so as to cancel X
    BOOST_TEST(torque_balance(0.0, 2.0, 0.5).negative == 0.25);
    BOOST_TEST(torque_balance(0.0, 0.0, 0.0).positive == 1.0);
}

BOOST_AUTO_TEST_CASE(the_multipliers_of_gauss_and_where_they_are_left_off) {
    const double I = 4.0, L = 1.5, twice_K = 3.0, health = 1.0 - L * L / (twice_K * I);
    // L_dot that uses up the rest of K before `part` of half a radian.
    const auto after = [&](double part) { return -I * health * twice_K / (I * part); };
    for (const double part : {1.01, 1.5, 30.0})
        for (const double sign : {1.0, -1.0}) {
            const GaussMultipliers m = gauss_multipliers(I, L, twice_K, sign * after(part));
            BOOST_TEST(!m.singular);
            BOOST_TEST(m.health == health, boost::test_tools::tolerance(1e-14));
            BOOST_TEST(m.alpha == sign * L / (I * part), boost::test_tools::tolerance(1e-14));
            BOOST_TEST(m.beta == m.alpha * twice_K / L, boost::test_tools::tolerance(1e-14));
        }
    for (const double part : {0.99, 0.6, 0.01})
        for (const double sign : {1.0, -1.0}) {
            const GaussMultipliers m = gauss_multipliers(I, L, twice_K, sign * after(part));
            BOOST_TEST(m.singular);
            BOOST_TEST(m.alpha == 0.0);
            BOOST_TEST(m.beta == 0.0);
        }
    BOOST_TEST(gauss_multipliers(I, std::sqrt(twice_K * I), twice_K, 1.0).singular);  // rigid
    BOOST_TEST(!gauss_multipliers(I, 0.0, 0.0, 0.0).singular);                        // at rest
}

BOOST_AUTO_TEST_CASE(a_particle_does_not_act_on_itself) {
    std::mt19937_64 random(34);
    const auto i = random_record<2>(random);
    const auto pair = make_pair<2, double>(Lucy<2>(3.0), separation(i.x, i.x), i, i);
    const auto f = balanced(pair, i, i);
    BOOST_TEST(f[0] == 0.0);
    BOOST_TEST(f[1] == 0.0);
}

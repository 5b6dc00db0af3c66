// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/material/elastic_solid.hpp>
#include <spam/material/harmonic_spring.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;

namespace {

/// The law with the rotation terms of the wrong sign.
struct ReversedSpin {
    ElasticSolid law;
    SymTensor<2> stress_rate(const Mat<2>& G, const SymTensor<2>& s) const {
        Mat<2> transposed;
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) transposed(a, b) = G(b, a);
        return law.stress_rate(transposed, s);
    }
};

/// sigma after time t of rigid spin omega about z, from sigma_xy = 1, by RK4 on the law itself.
template <int Dim, class Law>
SymTensor<Dim> spun(const Law& law, double omega, double t) {
    Mat<Dim> G;  // v = omega (-y, x): d v_y/dx = omega, d v_x/dy = -omega
    G(0, 1) = omega;
    G(1, 0) = -omega;
    SymTensor<Dim> s;
    s(0, 1) = 1.0;
    const int steps = 2000;
    const double h = t / steps;
    for (int k = 0; k < steps; ++k) {
        const auto k1 = law.stress_rate(G, s), k2 = law.stress_rate(G, s + (0.5 * h) * k1);
        const auto k3 = law.stress_rate(G, s + (0.5 * h) * k2), k4 = law.stress_rate(G, s + h * k3);
        s = s + (h / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return s;
}

}  // namespace

BOOST_AUTO_TEST_CASE(rigid_spin_turns_the_stress) {
    const ElasticSolid law{0.7, 0.4};
    const double w = 0.8, t = 1.3;
    const auto plane = spun<2>(law, w, t);
    BOOST_TEST(std::abs(plane(0, 1) - std::cos(2 * w * t)) < 1e-12);
    BOOST_TEST(std::abs(plane(0, 0) + std::sin(2 * w * t)) < 1e-12);
    BOOST_TEST(std::abs(plane(1, 1) - std::sin(2 * w * t)) < 1e-12);
    const auto space = spun<3>(law, w, t);
    BOOST_TEST(std::abs(space(0, 1) - std::cos(2 * w * t)) < 1e-12);
    BOOST_TEST(std::abs(space(0, 0) + std::sin(2 * w * t)) < 1e-12);
    BOOST_TEST(space(2, 2) == 0.0);
    const auto wrong = spun<2>(ReversedSpin{law}, w, t);
    BOOST_TEST(std::abs(wrong(0, 0) + std::sin(2 * w * t)) > 0.1);
}

BOOST_AUTO_TEST_CASE(hookes_law_without_rotation) {
    const ElasticSolid law{0.7, 0.4};
    Mat<3> G;
    G(0, 0) = 0.1;
    G(1, 1) = 0.2;
    G(2, 2) = -0.05;
    G(0, 2) = G(2, 0) = 0.03;
    const auto rate = law.stress_rate(G, SymTensor<3>{});
    BOOST_TEST(std::abs(rate(0, 0) - (0.7 * 0.25 + 0.8 * 0.1)) < 1e-15);
    BOOST_TEST(std::abs(rate(1, 1) - (0.7 * 0.25 + 0.8 * 0.2)) < 1e-15);
    BOOST_TEST(std::abs(rate(0, 2) - 0.8 * 0.03) < 1e-15);
    BOOST_TEST(rate(0, 1) == 0.0);
}

BOOST_AUTO_TEST_CASE(the_bar_is_lambda_plus_two_eta) {
    Mat<1> G;
    G(0, 0) = 0.1;
    SymTensor<1> stress;
    stress(0, 0) = 5.0;
    BOOST_TEST(std::abs(ElasticSolid{0.7, 0.4}.stress_rate(G, stress)(0, 0) - 1.5 * 0.1) < 1e-15);
}

BOOST_AUTO_TEST_CASE(spring_force_is_minus_the_slope_of_its_energy) {
    const HarmonicSpring spring{1.7, 1.1};
    for (const double r : {0.5, 1.0, 1.1, 2.0}) {
        const double h = 1e-6;
        const double slope = (spring.energy(r + h) - spring.energy(r - h)) / (2 * h);
        BOOST_TEST(std::abs(spring.force(r) + slope) < 1e-9);
    }
    BOOST_TEST(spring.force(1.1) == 0.0);
}

namespace {
const double copied = triangular_density;  // before main() begins, in any order of files
}

BOOST_AUTO_TEST_CASE(constants_of_the_triangular_lattice_are_there_before_anything_else) {
    BOOST_TEST(copied == std::sqrt(4.0 / 3.0));
    BOOST_TEST(triangular_modulus == std::sqrt(3.0 / 16.0));
    static_assert(triangular_density > 1.15 && triangular_modulus < 0.44);
    BOOST_TEST(ElasticSolid::triangular_lattice().eta == triangular_modulus);
}

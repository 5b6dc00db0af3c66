// SPDX-License-Identifier: GPL-3.0-or-later
// What holds a lattice of smooth particles together, [HH07] 8: the second derivatives of the potentials
// of the density on periodic lattices of 10 x 10 particles. With e(rho) alone one direction in two costs
// nothing and the shear modulus is zero; curvature gives strength, gradients what is left.
//
// The counts are exact. A wave exp(ik.r) changes the density by i k-odd sums of grad w: one number for
// two coordinates, so one direction of each of the 100 wave vectors is free, and both where k and -k are
// the same wave. Of these there are s = 2 on the triangular block (one M point fits into it), 4 on the
// square: 100 + s modes. Curvatures change by odd sums as well: 2s are left. Gradients change by even
// ones: only the two translations are left.
#include <spam/kernel/lucy.hpp>
#include <spam/kernel/wn.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/physics/curvature_strength.hpp>
#include <spam/physics/embedded_energy.hpp>
#include <spam/physics/surface_tension.hpp>
#include <spam/setup/lattices.hpp>

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>

using namespace spam;

namespace {

struct Lattice {
    Points<2> x;
    Box<2> box;
    std::vector<double> mass = std::vector<double>(100, 1.0);

    static Lattice triangular() { return {triangular_block(10, 10), triangular_box(10, 10)}; }
    static Lattice square() { return {square_lattice<2>({10, 10}), Box<2>({10.0, 10.0})}; }

    /// Energy and forces of `term` with the particles at `at` in `in`.
    template <class Term, class Weight>
    EnergyAndForces<2> evaluate(const Term& term, const Weight& w, const Points<2>& at,
                                const Box<2>& in) const {
        const PairList<2> pairs(at, w.range(), in);
        return energy_and_forces<2>(term, w, Neighbourhood<2>{at, mass, pairs, in});
    }

    /// The fluid that is at rest on this lattice: rho0 is what particles sum to at a site.
    template <class Weight>
    EmbeddedEnergy<EmbeddedAtom> fluid(const Weight& w, double misfit = 1.0) const {
        const PairList<2> pairs(x, w.range(), box);
        const EmbeddedEnergy<EmbeddedAtom> any{{1.0, 1.0}};
        const Neighbourhood<2> near{x, mass, pairs, box};
        return {{1.0, misfit * density_fields<2>(any, w, near)[0]}};
    }

    /// Second derivatives of the energy, 200 x 200, by differences of the forces.
    template <class Term, class Weight>
    Eigen::MatrixXd hessian(const Term& term, const Weight& w) const {
        const double d = 1e-4;
        Eigen::MatrixXd H(2 * x.cols(), 2 * x.cols());
        for (Eigen::Index k = 0; k < H.cols(); ++k) {
            const auto force = [&](double shift) {
                Points<2> moved = x;
                moved.reshaped()(k) += shift;
                return evaluate(term, w, moved, box).force.reshaped().eval();
            };
            H.col(k) =
                -(8.0 * (force(d) - force(-d)) - (force(2 * d) - force(-2 * d))) / (12.0 * d);
        }
        return 0.5 * (H + H.transpose());
    }

    /// Shear modulus at constant area: E'' = 4 G V for x e^s, y e^-s. On the square lattice that is
    /// (C11 - C12)/2.
    template <class Term, class Weight>
    double shear_modulus(const Term& term, const Weight& w) const {
        const auto energy = [&](double s) {
            Points<2> strained = x;
            strained.row(0) *= std::exp(s);
            strained.row(1) *= std::exp(-s);
            const Box<2> in({box.length(0) * std::exp(s), box.length(1) * std::exp(-s)});
            return evaluate(term, w, strained, in).energy;
        };
        const auto second = [&](double s) { return energy(s) + energy(-s) - 2.0 * energy(0.0); };
        const double s = 1e-3;
        return (16.0 * second(s) - second(2.0 * s)) / (12.0 * s * s) /
               (4.0 * box.length(0) * box.length(1));
    }
};

struct Modes {
    int zero, negative;
};

/// Differences leave 1e-12 of the largest eigenvalue; the smallest true ones here are 1e-5 of it.
Modes count(const Eigen::MatrixXd& H) {
    const Eigen::VectorXd value =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H, Eigen::EigenvaluesOnly).eigenvalues();
    const double zero = 1e-9 * value.cwiseAbs().maxCoeff();
    return {static_cast<int>((value.array().abs() < zero).count()),
            static_cast<int>((value.array() < -zero).count())};
}

template <class Weight>
void check_counts(const Lattice& lattice, double h, int self_conjugate) {
    BOOST_TEST_CONTEXT("h = " << h << ", " << self_conjugate << " waves with k = -k") {
        const Weight w(h);
        const Eigen::MatrixXd density = lattice.hessian(lattice.fluid(w), w);
        BOOST_TEST(count(density).zero == 100 + self_conjugate);
        BOOST_TEST(count(density).negative == 0);
        if constexpr (Weight::continuous_derivatives >= 3) {
            const Eigen::MatrixXd curvature = lattice.hessian(CurvatureStrength{0.1}, w);
            BOOST_TEST(count(density + curvature).zero == 2 * self_conjugate);
            BOOST_TEST(count(density + curvature).negative == 0);
            const Eigen::MatrixXd gradient = lattice.hessian(SurfaceTension{0.1}, w);
            BOOST_TEST(count(density + curvature + gradient).zero == 2);
            BOOST_TEST(count(density + curvature + gradient).negative == 0);
            // With the sign of the strength reversed the lattice falls apart.
            BOOST_TEST(count(density - curvature).negative > 50);
        }
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(modes_that_cost_nothing) {
    check_counts<Wn<2, 5>>(Lattice::triangular(), 2.5, 2);
    check_counts<Wn<2, 5>>(Lattice::triangular(), 3.25, 2);
    check_counts<Wn<2, 5>>(Lattice::square(), 2.5, 4);
    check_counts<Wn<2, 5>>(Lattice::square(), 3.25, 4);
    check_counts<Lucy<2>>(Lattice::triangular(), 3.25, 2);
    check_counts<Lucy<2>>(Lattice::square(), 3.25, 4);
}

BOOST_AUTO_TEST_CASE(shear_modulus_comes_from_curvature_alone) {
    for (const Lattice& lattice : {Lattice::triangular(), Lattice::square()})
        for (const double h : {2.5, 3.25}) {
            const Wn<2, 5> w(h);
            BOOST_TEST(std::abs(lattice.shear_modulus(lattice.fluid(w), w)) < 1e-8);
            BOOST_TEST(std::abs(lattice.shear_modulus(SurfaceTension{1.0}, w)) < 1e-8);
            BOOST_TEST(lattice.shear_modulus(CurvatureStrength{1.0}, w) > 0.05);
        }
    const double G = Lattice::triangular().shear_modulus(CurvatureStrength{1.0}, Wn<2, 5>(2.5));
    BOOST_TEST_MESSAGE("triangular, w_5, h = 2.5: G = " << G << " s_c");
    BOOST_TEST(std::abs(G - 0.951) < 0.02 * 0.951);
}

BOOST_AUTO_TEST_CASE(a_wrong_rest_density_is_noticed) {
    // With mass per volume in place of the site's sum the lattice is under pressure, and then e(rho) has
    // a shear stiffness after all, of either sign.
    const Lattice lattice = Lattice::triangular();
    const Wn<2, 5> w(2.5);
    BOOST_TEST(std::abs(lattice.shear_modulus(lattice.fluid(w, 0.98), w)) > 1e-4);
}

BOOST_AUTO_TEST_CASE(the_estimate_of_the_text_is_a_particle_in_a_cage_not_a_modulus) {
    // [HH07] 8: "G = 90/(7 pi h^4)" is half the trace of one particle's own block, the others held
    // fixed, for e = (rho - rho0)^2/2 and one particle per area.
    const Lattice lattice = Lattice::square();
    const Lucy<2> w(4.5);
    const auto fluid = lattice.fluid(w);
    const Eigen::MatrixXd H = lattice.hessian(fluid, w) * std::pow(fluid.law.rho0, 3);
    const double expected = 90.0 / (7.0 * std::numbers::pi * std::pow(4.5, 4));
    BOOST_TEST(std::abs(H(0, 0) - expected) < 0.02 * expected);
    BOOST_TEST(std::abs(H(1, 1) - expected) < 0.02 * expected);
}

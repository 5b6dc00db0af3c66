// SPDX-License-Identifier: GPL-3.0-or-later
// What holds a lattice of smooth particles together, [HH07] 8: the second derivatives of the potentials
// of the density on periodic lattices of 10 x 10 particles. With e(rho) alone one direction in two costs
// nothing and the shear modulus is zero; curvature gives strength, gradients what is left.
//
// The counts are exact. A wave exp(ik.r) changes the density by i k-odd sums of grad w: one number for
// two coordinates, so one direction of each of the 100 wave vectors is free, and both where k and -k are
// the same wave. Of these there are s = 2 on the triangular block (one M point fits into it), 4 on the
// square: 100 + s modes. Curvatures change by odd sums as well: 2s are left. Gradients change by even
// ones: only the two translations are left, with curvature or without; but a gradient of long waves is
// small in k^2, so that it gives no modulus.
//
// Nothing is negative: at the rest density of the lattice every potential is a sum of squares that
// vanishes there. With mass per volume in place of the site's sum the lattice is under pressure, and
// may fall apart.
#include "lattice_stability/lattice_strength.hpp"

#include "support/effort.hpp"
#include <spam/kernel/any_weight.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/van_der_waals.hpp>
#include <spam/physics/curvature_strength.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>

using namespace spam;

namespace {

struct Lattice {
    const char* name;
    LatticeVectors vectors;
    Points<2> x;
    Box<2> box;
    int self_conjugate;  ///< waves with k = -k

    static Lattice triangular() {
        return {"triangular", LatticeVectors{{1.0, 0.5}, {0.0, std::sqrt(0.75)}},
                triangular_block(10, 10), triangular_box(10, 10), 2};
    }
    static Lattice square() {
        return {"square", LatticeVectors::Identity(), square_lattice<2>({10, 10}),
                Box<2>({10.0, 10.0}), 4};
    }
    /// The fluid that is at rest on this lattice, times `misfit`.
    EmbeddedAtom fluid(Kernel kernel, double h, double misfit = 1.0) const {
        return {1.0, misfit * site_density(vectors, kernel, h)};
    }
    DensityPotentials density(Kernel kernel, double h) const {
        return {.state = fluid(kernel, h), .kernel = kernel, .range = h};
    }
    LatticeSpectrum spectrum(const DensityPotentials& p) const {
        return LatticeSpectrum(hessian(p, x, box));
    }
};

const Lattice lattices[] = {Lattice::triangular(), Lattice::square()};

/// Zero modes, nothing negative, and a wide gap about the threshold.
void check_count(const Lattice& lattice, const DensityPotentials& p, int zero) {
    BOOST_TEST_CONTEXT(lattice.name << ", s_c = " << p.strength << ", s_g = " << p.surface_tension
                                    << ", " << to_string(p.kernel) << ", h = " << p.range) {
        const LatticeSpectrum modes = lattice.spectrum(p);
        BOOST_TEST(modes.zero == zero);
        BOOST_TEST(modes.negative == 0);
        BOOST_TEST(modes.largest_zero < 1e-12);
        BOOST_TEST(modes.smallest_other > 5e-7);
    }
}

/// G/s_c of the triangular lattice with w_5 from one sum. The energy of a particle, s_c A^2 with
/// A = rho_xx - rho_yy = sum q (x^2 - y^2) and q = (w'' - w'/r)/r^2, is s_c (A' s)^2 in the shear x e^s,
/// y e^-s; its second derivative is 4 G times the area sqrt(3/4).
double shear_modulus_by_hand(double h) {
    const double C = 28.0 / (3.0 * std::numbers::pi * h * h);
    double slope = 0.0;  // A' = sum (q'/r) (x^2 - y^2)^2 + 2 q r^2,  q = 120 C (1 - u)^3/(h^3 r)
    for (int a = -6; a <= 6; ++a)
        for (int b = -6; b <= 6; ++b) {
            const double x = a + 0.5 * b, y = b * std::sqrt(0.75), r = std::hypot(x, y);
            if (r == 0.0 || r >= h) continue;
            const double rest = 1.0 - r / h, k = 120.0 * C * rest * rest / (h * h * h);
            const double q = k * rest / r, q_prime = -k * (3.0 / (h * r) + rest / (r * r));
            const double d = x * x - y * y;
            slope += q_prime / r * d * d + 2.0 * q * r * r;
        }
    return slope * slope / (2.0 * std::sqrt(0.75));
}

}  // namespace

BOOST_AUTO_TEST_CASE(modes_that_cost_nothing) {
    for (const Lattice& lattice : lattices)
        for (const double h : test::effort<std::vector<double>>({2.5, 3.25}, {2.5}, {2.5})) {
            DensityPotentials p = lattice.density(Kernel::w5, h);
            check_count(lattice, p, 100 + lattice.self_conjugate);
            p.strength = 0.1;
            check_count(lattice, p, 2 * lattice.self_conjugate);
            p.surface_tension = 0.1;
            check_count(lattice, p, 2);
            p.strength = 0.0;
            check_count(lattice, p, 2);
            check_count(lattice, lattice.density(Kernel::lucy, h), 100 + lattice.self_conjugate);
        }
}

BOOST_AUTO_TEST_CASE(with_the_sign_of_the_strength_reversed_the_lattice_falls_apart) {
    for (const Lattice& lattice : lattices) {
        DensityPotentials p = lattice.density(Kernel::w5, 3.25);
        p.strength = -0.1;
        BOOST_TEST(lattice.spectrum(p).negative > 50);
    }
}

BOOST_AUTO_TEST_CASE(shear_modulus_comes_from_curvature_alone) {
    for (const Lattice& lattice : lattices)
        for (const double h : {2.5, 3.25}) {
            DensityPotentials p = lattice.density(Kernel::w5, h);
            p.surface_tension = 1.0;
            const ElasticModuli fluid = elastic_moduli(p, lattice.vectors);
            BOOST_TEST(std::abs(fluid.shear) < 1e-8);
            BOOST_TEST(std::abs(fluid.diagonal_shear) < 1e-8);
            BOOST_TEST(std::abs(fluid.pressure) < 1e-8);
            // K = (rho^2 e'' + ...) of the law with d ln rho/d ln A not quite -1
            BOOST_TEST(std::abs(fluid.bulk - 1.0) < 0.25);
            p.strength = 1.0;
            const ElasticModuli solid = elastic_moduli(p, lattice.vectors);
            BOOST_TEST(solid.shear > 0.05);
            BOOST_TEST(solid.diagonal_shear > 0.01);
            const double anisotropy = std::abs(solid.shear / solid.diagonal_shear - 1.0);
            if (lattice.self_conjugate == 2)  // three mirrors: isotropic
                BOOST_TEST(anisotropy < 1e-6);
            else
                BOOST_TEST(anisotropy > 5.0);
        }
    const DensityPotentials strength{.strength = 1.0, .kernel = Kernel::w5, .range = 2.5};
    const double G = elastic_moduli(strength, lattices[0].vectors).shear;
    BOOST_TEST_MESSAGE("triangular, w_5, h = 2.5: G = " << G << " s_c");
    BOOST_TEST(std::abs(G - shear_modulus_by_hand(2.5)) < 1e-6);
    BOOST_TEST(std::abs(G - 0.94928) < 1e-5);
}

BOOST_AUTO_TEST_CASE(moduli_are_those_of_a_deformed_block) {
    // The same energies by sums over a periodic block, in which a core acts as well.
    const Lattice& lattice = lattices[0];
    DensityPotentials p = lattice.density(Kernel::w5, 2.5);
    p.strength = 0.3;
    p.core = {0.2, 1.4};
    const CurvatureStrength curvature{p.strength};
    const AnyWeight<2> w = weight_function<2>("w5", p.range);
    const std::vector<double> mass(100, 1.0);
    const auto energy = [&](double s) {
        Points<2> x = lattice.x;
        x.row(0) *= std::exp(s);
        x.row(1) *= std::exp(-s);
        const Box<2> box({10.0 * std::exp(s), lattice.box.length(1) * std::exp(-s)});
        const PairList<2> pairs(x, p.range, box);
        const ListedParticles<2> near{x, mass, pairs, box};
        return energy_and_forces<2>(curvature, w, near).energy +
               energy_and_forces<2>(p.core, near).energy;
    };
    const double s = 1e-3;
    const auto second = [&](double by) { return energy(by) + energy(-by) - 2.0 * energy(0.0); };
    const double G = (16.0 * second(s) - second(2.0 * s)) / (12.0 * s * s) /
                     (4.0 * lattice.box.length(0) * lattice.box.length(1));
    BOOST_TEST(std::abs(elastic_moduli(p, lattice.vectors).shear - G) < 1e-7);
}

BOOST_AUTO_TEST_CASE(a_wrong_rest_density_is_noticed) {
    // With mass per volume in place of the site's sum the lattice is under pressure, and then e(rho) has
    // a shear stiffness after all, of either sign. Lucy's triangular lattice near h = 2.6 and all square
    // ones then fall apart.
    DensityPotentials p = lattices[0].density(Kernel::w5, 2.5);
    p.state = lattices[0].fluid(p.kernel, p.range, 0.98);
    BOOST_TEST(std::abs(elastic_moduli(p, lattices[0].vectors).shear) > 1e-4);
    const double per_volume = std::sqrt(4.0 / 3.0);
    for (const double h :
         test::effort<std::vector<double>>({2.5, 2.6, 2.7, 2.8}, {2.5, 2.7}, {2.6})) {
        DensityPotentials lucy = lattices[0].density(Kernel::lucy, h);
        lucy.surface_tension = 0.1;
        BOOST_TEST(lattices[0].spectrum(lucy).negative == 0);
        lucy.state = EmbeddedAtom{1.0, per_volume};
        BOOST_TEST(lattices[0].spectrum(lucy).negative == 12);
    }
    DensityPotentials both = lattices[1].density(Kernel::w5, 3.25);
    both.strength = both.surface_tension = 0.1;
    both.state = EmbeddedAtom{1.0, 1.0};
    BOOST_TEST(lattices[1].spectrum(both).negative == 2);
}

BOOST_AUTO_TEST_CASE(the_estimate_of_the_text_is_a_particle_in_a_cage_not_a_modulus) {
    // [HH07] 8: "G = 90/(7 pi h^4)" is half the trace of one particle's own block, the others held
    // fixed, for e = (rho - rho0)^2/2 and one particle per area.
    const Lattice& lattice = lattices[1];
    const DensityPotentials p = lattice.density(Kernel::lucy, 4.5);
    const double rho0 = lattice.fluid(p.kernel, p.range).rho0;
    const Eigen::MatrixXd H = hessian(p, lattice.x, lattice.box) * std::pow(rho0, 3);
    const double expected = 90.0 / (7.0 * std::numbers::pi * std::pow(4.5, 4));
    BOOST_TEST(std::abs(H(0, 0) - expected) < 0.02 * expected);
    BOOST_TEST(std::abs(H(1, 1) - expected) < 0.02 * expected);
}

BOOST_AUTO_TEST_CASE(what_has_no_meaning_is_refused) {
    const Lattice& lattice = lattices[0];
    const auto refused = [&](const DensityPotentials& p, const char* word) {
        const auto says = [&](const InputError& error) {
            return std::string(error.what()).find(word) != std::string::npos;
        };
        BOOST_CHECK_EXCEPTION(hessian(p, lattice.x, lattice.box), InputError, says);
        BOOST_CHECK_EXCEPTION(elastic_moduli(p, lattice.vectors), InputError, says);
    };
    DensityPotentials p = lattice.density(Kernel::lucy, 3.0);
    p.strength = 0.1;
    refused(p, "use w4 or smoother");
    refused({.range = 3.0}, "nothing acts");
    refused({.state = VanDerWaals{}, .range = 3.0}, "temperature");
    refused({.strength = 0.1, .kernel = Kernel::w5, .range = -1.0}, "range");
    BOOST_CHECK_THROW(hessian(lattice.density(Kernel::w5, 5.0), lattice.x, lattice.box),
                      InputError);
}

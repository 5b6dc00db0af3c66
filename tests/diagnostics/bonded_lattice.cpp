// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of lattices of material vectors: against the rates of the model, what symmetry demands, and what keeps
// short waves from growing under tension. Each with a law that breaks it.
#include "support/random_state.hpp"
#include <spam/analysis/bonded_lattice.hpp>
#include <spam/analysis/wave_vectors.hpp>
#include <spam/core/error.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/setup/lattices.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <numbers>

using namespace spam;
using namespace spam::test;

namespace {

const auto solid = PolynomialSolid::like(ElasticSolid::triangular_lattice());
const double rho = std::sqrt(4.0 / 3.0), c_T = std::sqrt(3.0 / 8.0);

Eigen::Matrix2d stress(double xx, double yy, double xy) {
    Eigen::Matrix2d s;
    s << xx, xy, xy, yy;
    return s;
}

BondedLattice<2> lattice(const Eigen::Matrix2d& cauchy, double penalty, double range = 3.0,
                         BondMemory memory = BondMemory::kept) {
    return {triangular_basis(),
            solid,
            {rho, range, penalty},
            deformation_under<2>(solid, cauchy),
            memory};
}

/// Acceleration of the particle at the origin when all others move by u cos(k . r), by the rates of the
/// model: a body in open space so large that the one in the middle knows nothing of its border.
template <int Dim>
Point<Dim> acceleration_in(const Points<Dim>& sites, const HyperelasticMaterial<Dim>& material,
                           const MaterialVectorScheme& scheme,
                           const Eigen::Matrix<double, Dim, Dim>& F, const Point<Dim>& k,
                           const Point<Dim>& u) {
    MaterialVectorModel<Dim> model(make_particles<Dim>(sites, 1.0), material, scheme);
    const Points<Dim> X = model.particles().reference_position;
    std::vector<double> y(model.layout().size(), 0.0);
    State<Dim>(model.layout(), y).position() = F * X;
    model.settle(0.0, y);
    const std::vector<double> rest = y;
    Eigen::Index middle = 0;
    X.colwise().squaredNorm().minCoeff(&middle);
    const auto acceleration = [&](double by) -> Point<Dim> {
        y = rest;
        auto x = State<Dim>(model.layout(), y).position();
        for (Eigen::Index i = 0; i < X.cols(); ++i) {
            const Point<Dim> r = F * X.col(i);
            x.col(i) += by * std::cos(k.dot(r)) * u;
        }
        std::vector<double> y_dot(y.size());
        model.rates(0.0, y, y_dot);
        return ConstState<Dim>(model.layout(), y_dot).velocity().col(middle);
    };
    constexpr double step = 1e-4;
    const Point<Dim> wide = (acceleration(2.0 * step) - acceleration(-2.0 * step)) / (4.0 * step),
                     near = (acceleration(step) - acceleration(-step)) / (2.0 * step);
    return (4.0 * near - wide) / 3.0;
}

/// All wave vectors of a sample of cells x cells, in the first zone of the strained lattice.
template <class Visit>
void each_wave(const Eigen::Matrix2d& F, int cells, const Visit& visit) {
    const Eigen::Matrix2d strained = F.inverse().transpose();
    const Points<2> free = allowed_wave_vectors<2>(triangular_box(cells, cells), {cells, cells});
    for (const auto& k : free.colwise())
        if (k.norm() > 1e-9) visit(Point<2>(strained * first_zone(k)));
}

struct Extremes {
    double growth = 0.0, lowest = HUGE_VAL;
};
Extremes extremes(const Eigen::Matrix2d& cauchy, double penalty, double range = 3.0, int cells = 24,
                  BondMemory memory = BondMemory::kept) {
    const auto modes = lattice(cauchy, penalty, range, memory);
    Extremes found;
    each_wave(deformation_under<2>(solid, cauchy), cells, [&](const Point<2>& k) {
        found.growth = std::max(found.growth, modes.growth_rate(k));
        found.lowest = std::min(found.lowest, modes.frequencies(k).back() / (c_T * k.norm()));
    });
    return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_strain_for_a_stress) {
    for (const auto& cauchy : {stress(0.02, 0.02, 0.0), stress(0.2, -0.1, 0.05)}) {
        BOOST_TEST((lattice(cauchy, 1.0).stress() - cauchy).norm() < 1e-13);
        const auto of_another =
            BondedLattice<2>(triangular_basis(), StVenantKirchhoff{0.5, 0.4}, {rho},
                             deformation_under<2>(StVenantKirchhoff{0.5, 0.4}, cauchy));
        BOOST_TEST((of_another.stress() - cauchy).norm() < 1e-13);
    }
    // f^2 = 1 + stress/(lambda + eta)
    BOOST_TEST(std::abs(deformation_under<2>(solid, stress(0.2, 0.2, 0.0))(0, 0) -
                        std::sqrt(1.0 + 0.2 / std::sqrt(0.75))) < 1e-12);
    BOOST_CHECK_THROW(deformation_under<2>(solid, stress(-5.0, -5.0, 0.0)), InputError);
}

BOOST_AUTO_TEST_CASE(they_are_those_of_the_models_rates) {
    const Point<2> u(0.8, -0.6), k(1.1, 2.3);
    for (const auto& cauchy : {stress(0.0, 0.0, 0.0), stress(0.2, 0.2, 0.0),
                               stress(-0.2, -0.2, 0.0), stress(0.12, 0.05, 0.05)})
        for (const double penalty : {0.0, 1.0}) {
            const Eigen::Matrix2d F = deformation_under<2>(solid, cauchy);
            const Point<2> rates =
                acceleration_in<2>(triangular_disk(9.0), solid, {rho, 2.8, penalty}, F, k, u);
            const auto modes = lattice(cauchy, penalty, 2.8);
            const auto difference = [&](const BondedLattice<2>& other) {
                return (other.stiffness(k).real() * u + rates).norm();
            };
            BOOST_TEST(difference(modes) < 1e-9);
            BOOST_TEST(modes.stiffness(k).imag().norm() <
                       1e-14);  // every site is a centre of symmetry
            // with another penalty, and with vectors that are renewed
            BOOST_TEST(difference(lattice(cauchy, penalty + 0.1, 2.8)) > 1e-3);
            if (cauchy.norm() > 0.0)
                BOOST_TEST(difference(lattice(cauchy, penalty, 2.8, BondMemory::renewed)) > 1e-3);
        }
}

BOOST_AUTO_TEST_CASE(in_space_too) {
    Eigen::Matrix3d basis;  // face-centred cubic, spacing 1
    basis << 0, 1, 1, 1, 0, 1, 1, 1, 0;
    basis *= std::sqrt(0.5);
    std::vector<Point<3>> inside;
    for (int a = -9; a <= 9; ++a)
        for (int b = -9; b <= 9; ++b)
            for (int c = -9; c <= 9; ++c) {
                const Point<3> X = basis * Point<3>(a, b, c);
                if (X.norm() < 5.6) inside.push_back(X);
            }
    Points<3> sites(3, static_cast<Eigen::Index>(inside.size()));
    for (std::size_t n = 0; n < inside.size(); ++n)
        sites.col(static_cast<Eigen::Index>(n)) = inside[n];
    const PolynomialSolid matter{0.5, 0.5};
    Eigen::Matrix3d F;
    F << 1.05, 0.02, 0.0, 0.02, 1.03, 0.01, 0.0, 0.01, 1.04;
    const MaterialVectorScheme scheme{std::sqrt(2.0), 1.8, 1.0};
    const Point<3> k(0.7, 1.3, -0.4), u(0.6, 0.0, -0.8);
    const Point<3> rates = acceleration_in<3>(sites, matter, scheme, F, k, u);
    const BondedLattice<3> modes(basis, matter, scheme, F);
    BOOST_TEST((modes.stiffness(k).real() * u + rates).norm() < 1e-9);
    const BondedLattice<3> free(basis, matter, scheme, Eigen::Matrix3d::Identity());
    BOOST_TEST((free.stiffness(k).real() * u + rates).norm() > 1e-3);
}

/// However the lattice is stressed: its energy is one function. Without memory it is not.
BOOST_AUTO_TEST_CASE(hermitian_with_memory) {
    const auto cauchy = stress(0.1, 0.02, 0.05);
    double kept = 0.0, renewed = 0.0;
    const auto a = lattice(cauchy, 1.0), b = lattice(cauchy, 0.0, 3.0, BondMemory::renewed);
    each_wave(deformation_under<2>(solid, cauchy), 8, [&](const Point<2>& k) {
        kept = std::max(kept, (a.stiffness(k) - a.stiffness(k).adjoint()).norm());
        renewed = std::max(renewed, (b.stiffness(k) - b.stiffness(k).adjoint()).norm());
    });
    BOOST_TEST(kept < 1e-14);
    BOOST_TEST(renewed > 1e-3);
}

BOOST_AUTO_TEST_CASE(no_zero_energy_modes_but_translations) {
    // smallest omega/(c_T k) at rest, rising with the root of kappa
    const std::pair<double, double> known[] = {
        {0.1, 0.123}, {0.3, 0.213}, {1.0, 0.389}, {2.0, 0.551}, {3.0, 0.674}};
    for (const auto& [penalty, lowest] : known) {
        const Extremes found = extremes(stress(0.0, 0.0, 0.0), penalty);
        BOOST_TEST(found.growth == 0.0);
        BOOST_TEST(std::abs(found.lowest - lowest) < 2e-3);
    }
    BOOST_TEST(extremes(stress(0.0, 0.0, 0.0), 0.0).lowest < 1e-6);
}

BOOST_AUTO_TEST_CASE(nothing_grows_under_tension) {
    for (const auto& cauchy :
         {stress(0.02, 0.02, 0.0), stress(0.2, 0.2, 0.0), stress(0.3, 0.3, 0.0),
          stress(0.1, 0.1, 0.05), stress(0.05, -0.05, 0.0), stress(-0.2, -0.2, 0.0)})
        BOOST_TEST(extremes(cauchy, 1.0).growth < 1e-8);
    BOOST_TEST(std::abs(extremes(stress(0.02, 0.02, 0.0), 1.0).lowest - 0.3916) < 1e-3);
    // too small a penalty, none, and no memory
    BOOST_TEST(extremes(stress(0.4, 0.4, 0.0), 0.3).growth > 0.1);
    BOOST_TEST(extremes(stress(0.02, 0.02, 0.0), 0.0).growth > 0.1);
    const double forgetful =
        extremes(stress(0.02, 0.02, 0.0), 0.0, 3.0, 60, BondMemory::renewed).growth;
    BOOST_TEST(std::abs(forgetful - 0.1010) < 5e-4);
    BOOST_TEST(extremes(stress(0.0, 0.0, 0.0), 0.0, 3.0, 24, BondMemory::renewed).growth < 1e-7);
}

/// MaterialVectorScheme::safe_tension() in 15 stresses: uniaxial, biaxial 2 to 1 and shear in five directions
/// each (one hydrostatic). Stable there; well above, one of them is not.
BOOST_AUTO_TEST_CASE(the_tension_that_a_penalty_keeps_stable) {
    const auto grows = [](const Eigen::Matrix2d& basis, double density, double penalty,
                          double range, double tension) {
        for (int kind = 0; kind < 15; ++kind) {
            const double minor = kind == 14 ? 1.0 : kind < 5 ? 0.0 : kind < 10 ? 0.5 : -1.0;
            const Eigen::Matrix2d turn =
                Eigen::Rotation2Dd(kind % 5 * std::numbers::pi / 16.0).toRotationMatrix();
            const Eigen::Matrix2d cauchy =
                turn * Eigen::Vector2d(tension, minor * tension).asDiagonal() * turn.transpose();
            const Eigen::Matrix2d F =
                deformation_under<2>(solid, Eigen::Matrix2d(0.5 * (cauchy + cauchy.transpose())));
            const BondedLattice<2> modes(basis, solid, {density, range, penalty}, F);
            const Eigen::Matrix2d reciprocal =
                2.0 * std::numbers::pi * (F * basis).inverse().transpose();
            for (int a = 0; a < 12; ++a)
                for (int b = 0; b <= 6; ++b)
                    if (a + b > 0 &&
                        modes.growth_rate(reciprocal * Point<2>(a / 12.0, b / 12.0)) > 1e-8)
                        return true;
        }
        return false;
    };
    const Eigen::Matrix2d square = Eigen::Matrix2d::Identity();
    for (const double range : {2.2, 2.6, 3.0, 3.5, 4.0})
        for (const double penalty : {0.1, 0.3, 1.0, 3.0})
            BOOST_TEST_CONTEXT("range " << range << ", penalty " << penalty) {
                const double safe =
                    MaterialVectorScheme{rho, range, penalty}.safe_tension(solid.stiffness(), 1.0);
                BOOST_TEST(!grows(triangular_basis(), rho, penalty, range, safe));
                BOOST_TEST(grows(triangular_basis(), rho, penalty, range, 2.4 * safe));
                BOOST_TEST(!grows(square, 1.0, penalty, range, 0.83 * safe));
            }
}

BOOST_AUTO_TEST_CASE(long_waves_are_elastic) {
    const Point<2> k(2.0 * std::numbers::pi / 100.0, 0.0);
    for (const double penalty : {0.3, 1.0, 3.0}) {
        const auto modes = lattice(stress(0.0, 0.0, 0.0), penalty);
        BOOST_TEST(std::abs(modes.frequency(k, {0.0, 1.0}) / k.norm() / c_T - 1.0) < 3e-3);
        BOOST_TEST(std::abs(modes.frequency(k, {1.0, 0.0}) / k.norm() / std::sqrt(9.0 / 8.0) -
                            1.0) < 3e-3);
    }
}

BOOST_AUTO_TEST_CASE(refused) {
    const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
    const auto make = [&](const MaterialVectorScheme& scheme) {
        return BondedLattice<2>(triangular_basis(), solid, scheme, one);
    };
    BOOST_CHECK_THROW(make({rho, 0.5}), InputError);
    BOOST_CHECK_THROW(make({rho, 1e6}), InputError);
    BOOST_CHECK_THROW(make({rho, 3.0, -1.0}), InputError);
    BOOST_CHECK_THROW(make({0.0}), InputError);
}

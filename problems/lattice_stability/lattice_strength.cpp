// SPDX-License-Identifier: GPL-3.0-or-later
#include "lattice_strength.hpp"

#include "../shared_options.hpp"
#include <spam/core/error.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/physics/curvature_strength.hpp>
#include <spam/physics/embedded_energy.hpp>
#include <spam/physics/surface_tension.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>

namespace spam {
namespace {

/// A law chosen at run time as EmbeddedEnergy wants it.
struct ColdLaw {
    AnyEquationOfState state;

    double pressure(double rho, double e) const { return state.pressure(rho, e); }
    double sound_speed_squared(double rho, double e) const {
        return std::pow(state.sound_speed(rho, e), 2);
    }
    double cold_energy(double rho) const { return state.cold_energy(rho); }
    std::string describe() const { return state.describe(); }
};

void check(const DensityPotentials& p) {
    if (p.state && !p.state->cold)
        refuse(
            "potential: the law '{}' needs a temperature; an energy of the density alone is needed",
            p.state->describe());
    if (!p.state && p.surface_tension == 0.0 && p.strength == 0.0 && p.core.e_c == 0.0)
        throw InputError(
            "potential: nothing acts; give a law, a surface tension, a strength or a core");
}

/// Calls `visit` with every potential of the density that acts.
template <class Visit>
void for_each_term(const DensityPotentials& p, const AnyWeight<2>& w, const Visit& visit) {
    const auto checked = [&](const auto& term) {
        check_smooth_enough<2>(term, w);
        visit(term);
    };
    if (p.state) checked(EmbeddedEnergy<ColdLaw>{{*p.state}});
    if (p.surface_tension != 0.0) checked(SurfaceTension{p.surface_tension});
    if (p.strength != 0.0) checked(CurvatureStrength{p.strength});
}

AnyWeight<2> weight_of(const DensityPotentials& p) {
    return weight_function<2>(to_string(p.kernel), p.range);
}

/// Calls `visit` with every lattice vector up to `reach`, zero included.
template <class Visit>
void for_each_site(const LatticeVectors& lattice, double reach, const Visit& visit) {
    const Eigen::Matrix2d inverse = lattice.inverse();
    const int most_1 = static_cast<int>(std::ceil(reach * inverse.row(0).norm()));
    const int most_2 = static_cast<int>(std::ceil(reach * inverse.row(1).norm()));
    for (int n_1 = -most_1; n_1 <= most_1; ++n_1)
        for (int n_2 = -most_2; n_2 <= most_2; ++n_2) {
            const Eigen::Vector2d r = lattice * Eigen::Vector2d(n_1, n_2);
            if (r.norm() < reach) visit(Vec<2>{{r.x(), r.y()}});
        }
}

/// Phi of one particle among its like.
double site_energy(const DensityPotentials& p, const AnyWeight<2>& w,
                   const LatticeVectors& lattice) {
    double energy = 0.0;
    for_each_term(p, w, [&]<class Term>(const Term& term) {
        typename Term::template Field<2> f{};
        for_each_site(lattice, p.range, [&](const Vec<2>& r) {
            f = f + 1.0 * Term::template weigh<2>(WeightAt<2>(w, r));
        });
        energy += term.template energy<2>(1.0, f);
    });
    if (p.core.e_c != 0.0)
        for_each_site(lattice, p.core.s, [&](const Vec<2>& r) {
            if (dot(r, r) > 0.0) energy += 0.5 * p.core.energy(dot(r, r));
        });
    return energy;
}

/// E' and E'' at s = 0, to the fourth order of the step.
struct Derivatives {
    double first, second;

    template <class Energy>
    explicit Derivatives(const Energy& energy) {
        const double s = 1e-3, E_0 = energy(0.0);
        const double up = energy(s), down = energy(-s);
        const double far_up = energy(2.0 * s), far_down = energy(-2.0 * s);
        first = (8.0 * (up - down) - (far_up - far_down)) / (12.0 * s);
        second =
            (16.0 * (up + down - 2.0 * E_0) - (far_up + far_down - 2.0 * E_0)) / (12.0 * s * s);
    }
};

Points<2> forces(const DensityPotentials& p, const AnyWeight<2>& w,
                 const ListedParticles<2>& near) {
    Points<2> force = Points<2>::Zero(2, near.position.cols());
    for_each_term(p, w,
                  [&](const auto& term) { force += energy_and_forces<2>(term, w, near).force; });
    if (p.core.e_c != 0.0) force += energy_and_forces<2>(p.core, near).force;
    return force;
}

}  // namespace

double site_density(const LatticeVectors& lattice, Kernel kernel, double range) {
    const AnyWeight<2> w = weight_function<2>(to_string(kernel), range);
    double rho = 0.0;
    for_each_site(lattice, range, [&](const Vec<2>& r) { rho += w.value(std::sqrt(dot(r, r))); });
    return rho;
}

ElasticModuli elastic_moduli(const DensityPotentials& potentials, const LatticeVectors& lattice) {
    check(potentials);
    const AnyWeight<2> w = weight_of(potentials);
    const auto of = [&](const auto& deformation) {
        return Derivatives([&](double s) {
            return site_energy(potentials, w, LatticeVectors(deformation(s) * lattice));
        });
    };
    const double area = std::abs(lattice.determinant());
    const Derivatives swelling =
        of([](double s) { return Eigen::Matrix2d(std::exp(s) * Eigen::Matrix2d::Identity()); });
    const Derivatives stretch = of([](double s) {
        return Eigen::Matrix2d{{std::exp(s), 0.0}, {0.0, std::exp(-s)}};
    });
    const Derivatives diagonal = of([](double s) {
        return Eigen::Matrix2d{{std::cosh(s), std::sinh(s)}, {std::sinh(s), std::cosh(s)}};
    });
    return {-swelling.first / (2.0 * area),
            (swelling.second - 2.0 * swelling.first) / (4.0 * area),  // A = A_0 e^2s
            stretch.second / (4.0 * area), diagonal.second / (4.0 * area)};
}

Eigen::MatrixXd hessian(const DensityPotentials& potentials, const Points<2>& position,
                        const Box<2>& box) {
    check(potentials);
    const AnyWeight<2> w = weight_of(potentials);
    const double d = 1e-4 * (potentials.range / 3.0);  // ranges are about three spacings
    const std::vector<double> mass(static_cast<std::size_t>(position.cols()), 1.0);
    // One list with a little skin serves all displacements.
    const PairList<2> pairs(position, std::max(potentials.range, potentials.core.s) + 4.0 * d, box);
    Points<2> moved = position;
    const auto force = [&](Eigen::Index k, double shift) {
        moved.reshaped()(k) += shift;
        const Eigen::VectorXd F =
            forces(potentials, w, ListedParticles<2>{moved, mass, pairs, box}).reshaped();
        moved.reshaped()(k) = position.reshaped()(k);
        return F;
    };
    Eigen::MatrixXd H(position.size(), position.size());
    for (Eigen::Index k = 0; k < H.cols(); ++k)
        H.col(k) = -(8.0 * (force(k, d) - force(k, -d)) - (force(k, 2 * d) - force(k, -2 * d))) /
                   (12.0 * d);
    return 0.5 * (H + H.transpose());
}

LatticeSpectrum::LatticeSpectrum(const Eigen::MatrixXd& hessian) {
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(hessian, Eigen::EigenvaluesOnly)
            .eigenvalues();
    eigenvalue.assign(values.begin(), values.end());
    const double largest = values.cwiseAbs().maxCoeff();
    smallest_other = 1.0;
    for (const double value : eigenvalue) {
        const double part = std::abs(value) / largest;
        if (part < threshold) {
            ++zero;
            largest_zero = std::max(largest_zero, part);
        } else {
            negative += value < 0.0 ? 1 : 0;
            smallest_other = std::min(smallest_other, part);
        }
    }
}

}  // namespace spam

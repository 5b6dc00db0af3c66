// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/material_vectors.hpp>

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <vector>

namespace spam::test {

/// Laws that are wrong.
enum class BondMutation {
    none,
    no_fade,       ///< the forces forget that weights change with distance
    one_sided,     ///< v_dot from t_ij alone
    fixed_weight,  ///< no g(|X|)
    no_misfit,     ///< kappa in the energy, not in the forces
    misfit_apart,  ///< the misfit of a particle that loses its neighbours does no work
};

/// Energy and forces of a solid with material vectors as the formulas stand there, bond by bond, for the
/// vectors that a model has now: W = (eta/2)(F:F - D) - eta (J - 1) + ((lambda + eta)/2)(J - 1)^2.
template <int Dim>
class MaterialVectorOracle {
  public:
    using Tensor = Eigen::Matrix<double, Dim, Dim>;
    using Vector = Eigen::Matrix<double, Dim, 1>;

    MaterialVectorOracle(const MaterialVectorModel<Dim>& model, double lambda, double eta,
                         std::span<const double> y, BondMutation mutation = BondMutation::none)
        : model_(model),
          lambda_(lambda),
          eta_(eta),
          mutation_(mutation),
          range_(model.scheme().range),
          rows_(model.particles().size()) {
        for (std::size_t k = 0; k < rows_.size(); ++k) rows_[k] = model.law.bonds(y, k);
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            // of the lattice at the start, which the model has measured
            N0_ = std::max(N0_, reference_trace(k) / Dim);
        }
    }

    double energy(std::span<const double> y) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < rows_.size(); ++k) sum += particle(y, k).energy;
        return sum;
    }

    /// Dim x N
    std::vector<Vector> forces(std::span<const double> y) const {
        std::vector<Vector> force(rows_.size(), Vector::Zero());
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            const Particle p = particle(y, k);
            for (const auto& bond : rows_[k]) {
                const Vector t = bond_force(y, k, bond, p);
                force[k] += t;
                if (mutation_ != BondMutation::one_sided) force[bond.partner] -= t;
            }
        }
        return force;
    }

    /// Particles that are neither whole nor alone.
    int partly_whole(std::span<const double> y) const {
        int n = 0;
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            const double th = particle(y, k).th;
            n += th > 1e-3 && th < 0.999;
        }
        return n;
    }

  private:
    using Bond = typename MaterialVectors<Dim>::Bond;
    struct Particle {
        Tensor F, K, G, H;
        double energy, th, c;
    };

    static Vector of(const Vec<Dim>& v) { return Eigen::Map<const Vector>(v.c.data()); }
    Vector separation(std::span<const double> y, std::size_t k, std::size_t j) const {
        Vector r;
        for (int a = 0; a < Dim; ++a)
            r[a] = model_.box().nearest_image(a, y[Dim * j + static_cast<std::size_t>(a)] -
                                                     y[Dim * k + static_cast<std::size_t>(a)]);
        return r;
    }
    double s(double r) const {
        const double z = std::clamp((1.0 - std::pow(r / range_, 2)) / 0.51, 0.0, 1.0);
        return z * z * (3.0 - 2.0 * z);
    }
    double slope(double r) const {
        const double z = std::clamp((1.0 - std::pow(r / range_, 2)) / 0.51, 0.0, 1.0);
        return -12.0 * z * (1.0 - z) * r / (0.51 * range_ * range_);
    }
    double g(const Vector& X) const {
        if (mutation_ == BondMutation::fixed_weight) return 1.0;
        return std::pow(std::max(0.0, 1.0 - X.norm() / (1.25 * range_)), 4);
    }
    double reference_trace(std::size_t k) const {
        double trace = 0.0;
        const auto& X = model_.particles().reference_position;
        const std::vector<double> start(X.data(), X.data() + X.size());
        for (std::size_t j = 0; j < rows_.size(); ++j) {
            if (j == k) continue;
            const Vector r = separation(start, k, j);
            const double w = std::pow(std::max(0.0, 1.0 - r.norm() / (1.25 * range_)), 4);
            trace += w * s(r.norm()) * r.squaredNorm();
        }
        return trace;
    }

    Particle particle(std::span<const double> y, std::size_t k) const {
        Tensor N = Tensor::Zero(), A = Tensor::Zero();
        for (const Bond& bond : rows_[k]) {
            const Vector r = separation(y, k, bond.partner), X = of(bond.X);
            const double w = g(X) * s(r.norm());
            N += w * X * X.transpose();
            A += w * r * X.transpose();
        }
        const double V = model_.particles().mass[k] / model_.scheme().density;
        Particle p;
        p.K = N.inverse();
        p.F = A * p.K;
        const double J = p.F.determinant(), q = Dim / p.K.trace();
        const double z = std::clamp(q / (0.1 * N0_), 0.0, 1.0);
        p.th = z * z * (3.0 - 2.0 * z);
        const double W = 0.5 * eta_ * (p.F.squaredNorm() - Dim) - eta_ * (J - 1.0) +
                         0.5 * (lambda_ + eta_) * std::pow(J - 1.0, 2);
        const Tensor P =
            eta_ * p.F + ((lambda_ + eta_) * (J - 1.0) - eta_) * J * p.F.inverse().transpose();
        p.G = V * p.th * P * p.K;
        const double c = model_.scheme().penalty * eta_ * V / N0_;
        p.c = p.th * c;
        double whole = V * W;
        for (const Bond& bond : rows_[k]) {
            const Vector r = separation(y, k, bond.partner), X = of(bond.X);
            whole += 0.5 * c * g(X) * s(r.norm()) * (r - p.F * X).squaredNorm();
        }
        p.energy = p.th * whole;
        if (mutation_ == BondMutation::misfit_apart) whole = V * W;
        p.H = whole * 6.0 * z * (1.0 - z) / (0.1 * N0_) * (q * q / Dim) * p.K * p.K;
        return p;
    }

    Vector bond_force(std::span<const double> y, std::size_t k, const Bond& bond,
                      const Particle& p) const {
        const Vector r = separation(y, k, bond.partner), X = of(bond.X), e = r - p.F * X;
        const double c = mutation_ == BondMutation::no_misfit ? 0.0 : p.c;
        Vector t = g(X) * s(r.norm()) * (p.G * X + c * e);
        if (mutation_ != BondMutation::no_fade)
            t += g(X) * slope(r.norm()) / r.norm() *
                 (e.dot(p.G * X) + 0.5 * c * e.squaredNorm() + X.dot(p.H * X)) * r;
        return t;
    }

    const MaterialVectorModel<Dim>& model_;
    double lambda_, eta_;
    BondMutation mutation_;
    double range_, N0_ = 0.0;
    std::vector<std::vector<Bond>> rows_;
};

template <int Dim>
std::vector<double> forces_of(const MaterialVectorOracle<Dim>& oracle, std::span<const double> y) {
    std::vector<double> f;
    for (const auto& force : oracle.forces(y)) f.insert(f.end(), force.data(), force.data() + Dim);
    return f;
}

}  // namespace spam::test

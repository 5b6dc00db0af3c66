// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/exact_sum.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <Eigen/Dense>

#include <numbers>
#include <optional>

namespace spam::test {

/// Laws that are wrong on purpose: each must make a property fail.
enum class LagrangianMutation {
    none,
    no_reaction,      ///< M_i left out of P_i: forces are no longer the slope of the energy
    fixed_axes,       ///< penalty on x_ij - X_ij, which does not turn with the body
    uncorrected,      ///< K_i = 1
    own_stress_only,  ///< 2 P_i K_i^t where a pair needs P_i K_i^t + P_j K_j^t
    small_strain      ///< E = (F + F^t)/2 - 1, which sees rotations as strain
};

/// The total-Lagrangian equations as loops over all pairs, with Eigen, sharing no sum, list, law or,
/// of Lucy's, weight function with the library. Slow, simple, and the judge of TotalLagrangianModel. With
/// X_ij = X_i - X_j, W_ij = w(|X_ij|), V the reference volume, kappa the penalty:
///     A_i = sum_j V_j (x_j - x_i) (x) grad_i W_ij,  K_i = A_i^-1 at the reference,  F_i = A_i K_i
///     E_i = (F^t F - 1)/2,   P_i = F_i (lambda tr(E_i) 1 + 2 eta E_i)
///     d_ij = x_ij - (F_i + F_j) X_ij/2,   k_ij = kappa mu V_i V_j W_ij/|X_ij|^2
///     M_i = sum_j k_ij d_ij (x) X_ij/2,   P_i -> P_i - M_i/V_i
///     m v_dot_i = sum_j V_i V_j (P_i K_i^t + P_j K_j^t) . grad_i W_ij - sum_j k_ij d_ij
template <int Dim>
class LagrangianOracle final : public Model<Dim> {
    using V = Point<Dim>;
    using M = Eigen::Matrix<double, Dim, Dim>;

  public:
    LagrangianOracle(Particles<Dim> particles, const StVenantKirchhoff& law,
                     const TotalLagrangianScheme& scheme, const Box<Dim>& box = {},
                     LagrangianMutation mutation = LagrangianMutation::none)
        : Model<Dim>(std::move(particles), box, {Field::position, Field::velocity}),
          law_(law),
          scheme_(scheme),
          mutation_(mutation),
          other_(scheme.kernel == Kernel::lucy
                     ? std::nullopt
                     : std::optional(weight_function<Dim>(to_string(scheme.kernel), scheme.range))),
          n_(static_cast<int>(this->particles().size())) {
        for (int i = 0; i < n_; ++i) {
            M A = M::Zero();
            for (int j = 0; j < n_; ++j) A += volume(j) * -X(i, j) * gradient(i, j).transpose();
            K_.push_back(mutation == LagrangianMutation::uncorrected ? M(M::Identity())
                                                                     : M(A.inverse()));
        }
    }

    void rates(double, std::span<const double> y, std::span<double> y_dot) override {
        const std::vector<M> F = gradients(y);
        std::vector<M> P;
        for (int i = 0; i < n_; ++i) {
            P.push_back(stress(F[at(i)]));
            for (int j = 0; j < n_ && mutation_ != LagrangianMutation::no_reaction; ++j)
                P[at(i)] -= 0.5 * k(i, j) * d(y, F, i, j) * X(i, j).transpose() / volume(i);
        }
        const State<Dim> rate(this->layout(), y_dot);
        rate.position() = ConstState<Dim>(this->layout(), y).velocity();
        for (int i = 0; i < n_; ++i) {
            V force = V::Zero();
            for (int j = 0; j < n_; ++j) {
                const M own = P[at(i)] * K_[at(i)].transpose();
                const M both = own + (mutation_ == LagrangianMutation::own_stress_only
                                          ? own
                                          : M(P[at(j)] * K_[at(j)].transpose()));
                force += volume(i) * volume(j) * both * gradient(i, j) - k(i, j) * d(y, F, i, j);
            }
            rate.velocity().col(i) = force / this->particles().mass[at(i)];
        }
    }

    double internal_energy(std::span<const double> y) const override {
        const std::vector<M> F = gradients(y);
        ExactSum sum;
        for (int i = 0; i < n_; ++i) {
            const M E = strain(F[at(i)]);
            sum += volume(i) *
                   (0.5 * law_.lambda * std::pow(E.trace(), 2) + law_.eta * E.squaredNorm());
            for (int j = 0; j < i; ++j) sum += 0.5 * k(i, j) * d(y, F, i, j).squaredNorm();
        }
        return sum;
    }

    std::vector<M> gradients(std::span<const double> y) const {
        std::vector<M> F;
        for (int i = 0; i < n_; ++i) {
            M A = M::Zero();
            for (int j = 0; j < n_; ++j) A += volume(j) * -x(y, i, j) * gradient(i, j).transpose();
            F.push_back(A * K_[at(i)]);
        }
        return F;
    }

    Promises promises() const override { return {}; }
    std::string describe() const override { return "oracle"; }
    std::size_t pairs() const override { return 0; }
    double reach() const override { return scheme_.range; }

  private:
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    double volume(int i) const { return this->particles().mass[at(i)] / scheme_.density; }

    /// X_i - X_j of the nearest image.
    V X(int i, int j) const { return raw(i, j) - periods(i, j); }
    /// x_i - x_j of the same image.
    V x(std::span<const double> y, int i, int j) const {
        const auto now = ConstState<Dim>(this->layout(), y).position();
        return now.col(i) - now.col(j) - periods(i, j);
    }
    V raw(int i, int j) const {
        const auto& reference = this->particles().reference_position;
        return reference.col(i) - reference.col(j);
    }
    V periods(int i, int j) const {
        V p = V::Zero();
        for (int a = 0; a < Dim; ++a)
            if (this->box().periodic(a))
                p[a] = this->box().length(a) * std::round(raw(i, j)[a] / this->box().length(a));
        return p;
    }

    double weight(double r) const {
        const double h = scheme_.range, pi = std::numbers::pi;
        if (r >= h) return 0.0;
        if (other_) return other_->value(r);
        const double C = Dim == 1   ? 5.0 / (4.0 * h)
                         : Dim == 2 ? 5.0 / (pi * h * h)
                                    : 105.0 / (16.0 * pi * h * h * h);
        return C * (1.0 + 3.0 * r / h) * std::pow(1.0 - r / h, 3);
    }
    V gradient(int i, int j) const {
        const double h = scheme_.range, r = X(i, j).norm();
        if (r >= h || i == j) return V::Zero();
        if (other_) return -other_->minus_slope_over_r(r) * X(i, j);
        // From w itself: w' = w (3/(h + 3r) - 3/(h - r)).
        return weight(r) * (3.0 / (h + 3.0 * r) - 3.0 / (h - r)) / r * X(i, j);
    }
    double k(int i, int j) const {
        if (i == j) return 0.0;
        return scheme_.penalty * volume(i) * volume(j) * weight(X(i, j).norm()) *
               std::max(law_.lambda, law_.eta) / X(i, j).squaredNorm();
    }
    V d(std::span<const double> y, const std::vector<M>& F, int i, int j) const {
        if (mutation_ == LagrangianMutation::fixed_axes) return x(y, i, j) - X(i, j);
        return x(y, i, j) - (F[at(i)] + F[at(j)]) * X(i, j) / 2.0;
    }

    M strain(const M& F) const {
        if (mutation_ == LagrangianMutation::small_strain)
            return (F + F.transpose()) / 2.0 - M::Identity();
        return (F.transpose() * F - M::Identity()) / 2.0;
    }
    M stress(const M& F) const {
        const M E = strain(F);
        const M S = law_.lambda * E.trace() * M::Identity() + 2.0 * law_.eta * E;
        return mutation_ == LagrangianMutation::small_strain ? S : M(F * S);
    }

    StVenantKirchhoff law_;
    TotalLagrangianScheme scheme_;
    LagrangianMutation mutation_;
    std::optional<AnyWeight<Dim>> other_;  ///< than Lucy's
    int n_;
    std::vector<M> K_;
};

}  // namespace spam::test

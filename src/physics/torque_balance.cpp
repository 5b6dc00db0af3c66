// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/physics/torque_balance_in_space.hpp>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace spam {
namespace {

/// Relative to the sum of |T|. Factors are known to a few units in the last place.
constexpr double balanced = 1e-13;
/// Directions whose torques are smaller count as free of them.
constexpr double no_torque = 1e-14;
constexpr int most_sums = 100;

double trace(const SymTensor<3>& t) { return t(0, 0) + t(1, 1) + t(2, 2); }

Eigen::Vector3d vector(const Vec<3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

void TorqueBalance::begin(const TorqueMoments& at_zero, const Vec<3>& X) {
    theta_ = {};
    X_ = X;
    size_ = trace(at_zero.spread);
    sums_ = 1;
    residual_ = 0.0;
    done_ = !(size_ > 0.0);
    if (!done_) step_from(at_zero);
}

void TorqueBalance::next(const TorqueMoments& at_theta) {
    const double Phi = trace(at_theta.spread) - dot(theta_, X_);
    const Vec<3> rest = at_theta.torque + X_;
    const double residual = std::sqrt(dot(rest, rest)) / size_;
    // Close to the end Phi is flat to round-off, and the residual says more.
    const bool nearer = Phi < Phi_ || (Phi <= Phi_ + 1e-15 * size_ && residual < residual_);
    if (++sums_ >= most_sums) done_ = true;
    if (nearer) return step_from(at_theta);
    step_ *= 0.5;
    theta_ = from_ + step_;
    if (done_ || theta_ == from_) {
        theta_ = from_;
        done_ = true;
    }
}

void TorqueBalance::step_from(const TorqueMoments& sums) {
    from_ = theta_;
    Phi_ = trace(sums.spread) - dot(theta_, X_);
    const Vec<3> rest = sums.torque + X_;
    residual_ = std::sqrt(dot(rest, rest)) / size_;
    if (done_ || !(residual_ > balanced)) {
        done_ = true;
        return;
    }
    Eigen::Matrix3d H;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) H(a, b) = sums.spread(a, b);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(H);
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
        if (modes.eigenvalues()[k] > no_torque * trace(sums.spread))
            step += modes.eigenvectors().col(k) *
                    (modes.eigenvectors().col(k).dot(vector(rest)) / modes.eigenvalues()[k]);
    // sum s |T| (step . n)^2: how far the exponents go, whatever the directions of the torques.
    const double reach = std::sqrt(step.dot(H * step) / trace(sums.spread));
    if (reach > 1.0) step /= reach;
    step_ = {{step[0], step[1], step[2]}};
    theta_ = from_ + step_;
    done_ = theta_ == from_ || !std::isfinite(reach);
    if (done_) theta_ = from_;
}

}  // namespace spam

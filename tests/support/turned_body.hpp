// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of every body whose energy rotations leave unchanged.
#pragma once

#include "support/random_state.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace spam::test {

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

/// About an axis along none of the coordinates.
template <int Dim>
Matrix<Dim> rotation(double angle) {
    if constexpr (Dim == 2) return Eigen::Rotation2Dd(angle).toRotationMatrix();
    if constexpr (Dim == 3)
        return Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -0.5).normalized())
            .toRotationMatrix();
    return Matrix<Dim>::Identity();
}

/// A random state whose particles have left their places by up to `distance` along each axis.
template <int Dim>
std::vector<double> moved(const Model<Dim>& model, double distance, unsigned seed) {
    auto y = random_state(model, seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-distance, distance);
    for (auto& x : State<Dim>(model.layout(), y).position().reshaped()) x += u(random);
    return y;
}

/// What turning and moving the body changes: the energy, and the forces seen in the body's axes.
template <int Dim>
double invariance_error(Model<Dim>& model, std::vector<double> y) {
    const double before = model.internal_energy(y);
    auto expected = rates_of(model, y);
    const Matrix<Dim> Q = rotation<Dim>(0.7);
    for (auto* turned : {&y, &expected}) {
        const State<Dim> s(model.layout(), *turned);
        s.position() = (Q * s.position()).eval();
        s.velocity() = (Q * s.velocity()).eval();
    }
    State<Dim>(model.layout(), y).position().array() += 3.7;
    return std::max(std::abs(model.internal_energy(y) / before - 1.0),
                    relative_difference(rates_of(model, y), expected));
}

/// m v_dot
template <int Dim>
std::vector<double> forces_of(Model<Dim>& model, std::span<const double> y) {
    const auto y_dot = rates_of(model, y);
    const std::size_t n = model.particles().size();
    std::vector<double> f(y_dot.begin() + static_cast<std::ptrdiff_t>(Dim * n), y_dot.end());
    for (std::size_t k = 0; k < f.size(); ++k) f[k] *= model.particles().mass[k / Dim];
    return f;
}

/// Largest difference between forces and minus the slope of the energy, by central differences of h and 2 h with
/// Richardson's extrapolation, relative to the largest force; every `stride`-th of them.
template <class Energy>
double slope_error(const std::vector<double>& y, const std::vector<double>& force,
                   const Energy& energy, double h, std::size_t stride = 1) {
    const auto difference = [&](std::size_t k, double step) {
        auto forward = y, backward = y;
        forward[k] += step;
        backward[k] -= step;
        return (energy(forward) - energy(backward)) / (2.0 * step);
    };
    double worst = 0.0, size = 0.0;
    for (std::size_t k = 0; k < force.size(); k += stride) {
        const double slope = (4.0 * difference(k, h) - difference(k, 2.0 * h)) / 3.0;
        worst = std::max(worst, std::abs(force[k] + slope));
        size = std::max(size, std::abs(force[k]));
    }
    return worst / size;
}
template <int Dim>
double slope_error(Model<Dim>& model, const std::vector<double>& y, double h,
                   std::size_t stride = 1) {
    const auto energy = [&](const auto& z) { return model.internal_energy(z); };
    return slope_error(y, forces_of(model, y), energy, h, stride);
}

/// |sum f| and |sum x f - f x|, relative to the sums of their terms.
template <int Dim>
std::array<double, 2> residuals(const std::vector<double>& y, const std::vector<double>& force) {
    Point<Dim> sum = Point<Dim>::Zero();
    Matrix<Dim> turn = Matrix<Dim>::Zero();
    double size = 0.0, torques = 0.0;
    for (std::size_t i = 0; i < force.size() / Dim; ++i) {
        const Eigen::Map<const Point<Dim>> f(&force[Dim * i]), x(&y[Dim * i]);
        const Matrix<Dim> torque = x * f.transpose() - f * x.transpose();
        sum += f;
        turn += torque;
        size += f.norm();
        torques += torque.norm();
    }
    return {sum.norm() / size, turn.norm() / torques};
}

}  // namespace spam::test

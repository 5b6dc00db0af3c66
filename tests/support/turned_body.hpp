// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of every body whose energy rotations leave unchanged.
#pragma once

#include "support/random_state.hpp"

#include <Eigen/Geometry>

#include <algorithm>
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

}  // namespace spam::test

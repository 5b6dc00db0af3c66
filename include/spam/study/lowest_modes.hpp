// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace spam {

/// The slowest small motions about a state, K u = omega^2 M u, K = - d force/d x.
struct LowestModes {
    std::vector<double>
        omega_squared;  ///< ascending; below 0: the state is unstable; 0: a motion without force
    /// Displacements of all particles, Dim N x modes, those of held ones 0; orthonormal with masses as weights.
    Eigen::MatrixXd shapes;
    /// Largest |M^-1/2 K u - omega^2 M^1/2 u|: no omega_squared is off by more.
    double largest_residual = 0.0;
    std::size_t rhs_evaluations = 0;
};

/// `count` of them, for models and with held particles as equilibrium() takes them. By Lanczos' method from `count`
/// vectors at once, so that as many alike are found, kept orthogonal to all before: memory for as many vectors as
/// there are products K v, of two right-hand sides each, at most the numbers of all free positions. The error of
/// omega_squared is about 1e-10 of the fastest. Throws InputError as equilibrium() does, and for a count that is not
/// between 1 and the numbers of free positions; GuardStop where forces have no meaning.
template <int Dim>
LowestModes lowest_modes(Model<Dim>& model, std::span<const double> y,
                         const std::vector<bool>& held, std::size_t count, double t = 0.0);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace spam {

/// A state at rest in which no particle that may move feels a force.
struct Equilibrium {
    std::vector<double> y;
    double largest_force = 0.0;
    std::size_t newton_steps = 0, rhs_evaluations = 0;
};

/// The equilibrium next to `y`, of a model whose forces have a potential: total Lagrangian, material vectors that do
/// not flow, springs, pair potentials; loads of externals as they are at time t. `held[i]`: that particle stays where
/// it is. Forces are below `tolerance` in the end. By Newton's method and conjugate gradients (integrate/root.hpp).
/// Throws InputError for a model whose y holds more than positions and velocities, whose forces depend on velocities,
/// whose particles yield, break or are reflected, or whose derivatives are not symmetric (tried once with two random
/// vectors); GuardStop where it does not converge: give the load in smaller steps.
template <int Dim>
Equilibrium equilibrium(Model<Dim>& model, std::span<const double> y, const std::vector<bool>& held,
                        double tolerance, double t = 0.0);

}  // namespace spam

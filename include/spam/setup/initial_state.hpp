// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>

#include <functional>
#include <vector>

namespace spam {

/// Velocity of a particle at reference position x.
template <int Dim>
using VelocityField = std::function<Point<Dim>(const Point<Dim>& x)>;

/// Rigid rotation about the origin, counterclockwise, angular velocity omega.
inline VelocityField<2> rigid_rotation(double omega) {
    return [omega](const Point<2>& x) { return Point<2>(-omega * x.y(), omega * x.x()); };
}

/// The same in space, about the axis of the vector omega.
inline VelocityField<3> rigid_rotation(const Point<3>& omega) {
    return [omega](const Point<3>& x) { return Point<3>(omega.cross(x)); };
}

template <int Dim>
VelocityField<Dim> at_rest() {
    return [](const Point<Dim>&) { return Point<Dim>(Point<Dim>::Zero()); };
}

/// y at the start: reference positions, the given velocities, density (where y carries it), no
/// stress, no internal energy. Scales of the layout are set for the tolerances, all by their units: position
/// by the spacing, velocity by the largest speed (its square for the energy) or, where all are at rest, by
/// sqrt(modulus/density), density by its value, stress and forces by `modulus`. Precondition: density and
/// modulus are positive.
template <int Dim>
std::vector<double> initial_state(Model<Dim>& model, double density, double modulus,
                                  const VelocityField<Dim>& velocity);

/// That of a triangular lattice of mass and spacing 1 and springs of constant 1 (setup/lattices.hpp).
std::vector<double> lattice_state(Model<2>& model, const VelocityField<2>& velocity);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/smooth_particles.hpp>

#include <memory>
#include <vector>

namespace spam {

/// A periodic solid and a state to start from.
struct PeriodicSolid {
    std::shared_ptr<SmoothParticleModel<2>> model;
    std::vector<double> y0;
};

/// Triangular lattice of columns x rows particles of mass and spacing one, at rest with the same
/// density (where it is integrated) and hydrostatic stress everywhere. Scales as initial_state()
/// sets them, stress by that of the lattice of springs. Throws InputError for an odd number of rows
/// and when the box is not wider than twice the range.
PeriodicSolid triangular_solid(int columns, int rows, const Material<2>& material,
                               const Scheme& scheme, double density, double stress);

/// The same, no larger than an analysis of its modes needs (LatticeModes).
PeriodicSolid smallest_triangular_solid(const Material<2>& material, const Scheme& scheme,
                                        double density, double stress);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/lattices.hpp>

#include <array>
#include <memory>
#include <vector>

namespace spam {

/// A periodic solid and a state to start from.
template <int Dim>
struct SolidLattice {
    std::shared_ptr<SmoothParticleModel<Dim>> model;
    std::vector<double> y0;
};
/// In the plane.
using PeriodicSolid = SolidLattice<2>;

/// Triangular lattice of columns x rows particles of mass and spacing one, at rest with the same
/// density (where it is integrated) and hydrostatic stress everywhere. Scales as initial_state()
/// sets them, stress by that of the lattice of springs. Throws InputError for an odd number of rows
/// and when the box is not wider than twice the range.
PeriodicSolid triangular_solid(int columns, int rows, const Material<2>& material,
                               const Scheme& scheme, double density, double stress);

/// The same, no larger than an analysis of its modes needs (LatticeModes).
PeriodicSolid smallest_triangular_solid(const Material<2>& material, const Scheme& scheme,
                                        double density, double stress);

/// The same two of a cubic lattice, nearest neighbours 1 apart, of so many cells along each axis; its density
/// is that of its particles. Ranges above 6 spacings are refused besides.
SolidLattice<3> cubic_solid(CubicLattice lattice, const std::array<int, 3>& cells,
                            const Material<3>& material, const Scheme& scheme, double stress);
SolidLattice<3> smallest_cubic_solid(CubicLattice lattice, const Material<3>& material,
                                     const Scheme& scheme, double stress);

}  // namespace spam

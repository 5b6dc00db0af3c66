// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/scheme.hpp>
#include <spam/rhs/model.hpp>

#include <memory>
#include <vector>

namespace spam {

/// A system ready to go: its equations and the state it starts from.
template <int Dim>
struct Start {
    std::shared_ptr<Model<Dim>> model;
    std::vector<double> y0;
};

/// The hexagon of [HHM04] VI, corners `size` spacings from the centre (1 + 3n + 3n^2 particles of mass
/// and spacing one), turning rigidly with `speed` at the corners: as smooth particles, as points bound
/// by springs, as a total-Lagrangian solid with the penalty 0.1, and as one with material vectors.
Start<2> smooth_hexagon(int size, double speed, const Scheme& scheme);
Start<2> bonded_hexagon(int size, double speed);
Start<2> lagrangian_hexagon(int size, double speed);
Start<2> material_vector_hexagon(int size, double speed);

/// Adds to every velocity component a number drawn evenly between -speed and speed (the same numbers
/// every time), their mean taken off: all modes of the body ring.
Start<2> shaken(Start<2> start, double speed);

/// A standing transverse wave, cells x cells particles, analysis/plane_wave.hpp.
Start<2> ringing_lattice(int cells, double amplitude, const Scheme& scheme);

/// cells x cells particles of Lucy's gas (range 6) at rest in the middle of a periodic box twice as
/// wide, each 0.1 (u - 1/2) off its site, u even between 0 and 1: free expansion, [HH01].
Start<2> expanding_gas(int cells);

}  // namespace spam

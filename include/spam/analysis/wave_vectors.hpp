// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/neighbors/box.hpp>

#include <string>
#include <vector>

namespace spam {

/// The wave vectors that fit into a periodic sample of a Bravais lattice with `cells` particles
/// along (or rows across) each side of the box, one a particle: k_a = 2 pi n_a / L_a, n_a = 0 ...
/// cells_a - 1. Dim x (product of cells). For square lattices and triangular blocks.
template <int Dim>
Points<Dim> allowed_wave_vectors(const Box<Dim>& box, const std::array<int, Dim>& cells);

/// The equivalent of k in the first Brillouin zone of the triangular lattice whose rows lie along x:
/// the shortest of k + G (of equal ones the first by angle from the x axis, counterclockwise).
Point<2> first_zone(const Point<2>& k, double spacing = 1.0);

/// A way through wave vectors: `distance` along it, and where its corners are.
struct WavePath {
    struct Corner {
        std::string name;
        double distance;
    };
    Points<2> k;
    std::vector<double> distance;
    std::vector<Corner> corners;
};

/// Gamma - K - M - Gamma of the triangular lattice whose rows lie along x: the border of the part of
/// the zone from which symmetry makes the whole. K = (4 pi/3, 0)/spacing, the zone's corner;
/// M = (pi, pi/sqrt(3))/spacing, the middle of an edge. About `points` wave vectors, evenly spaced.
WavePath triangular_path(int points, double spacing = 1.0);

}  // namespace spam

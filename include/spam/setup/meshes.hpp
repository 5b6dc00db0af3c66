// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>
#include <spam/neighbors/box.hpp>

#include <array>
#include <vector>

namespace spam {

/// A plane body of elements: nodes, and the four at the corners of each element, counterclockwise.
struct Mesh {
    Points<2> node;                      ///< 2 x nodes
    std::vector<Quadrilateral> element;  ///< by places in `node`
};

/// columns x rows squares, centred on the origin; nodes and elements row by row from the lower left. `around`: in x and
/// in y, the last one is followed by the first, as in a periodic box of these lengths.
/// Throws InputError where there is none.
Mesh rectangle_mesh(int columns, int rows, double spacing = 1.0, std::array<bool, 2> around = {});

/// n x n squares, mapped on a disk about the origin: every square about the centre becomes a circle, along rays.
/// Throws InputError where there is none.
Mesh disk_mesh(int n, double radius);

/// Particles at the nodes of some bodies, in strip order, `id` the place in the meshes one behind the other.
struct MeshedBodies {
    Particles<2>
        nodes;  ///< each with a quarter of the mass of every element that it is a corner of
    std::vector<Quadrilateral>
        element;  ///< of all bodies in their order, by the numbers of `nodes`
};

/// `density`: mass per area; `spacing`: the typical side of an element. Body 0, 1, ... is the mesh of that number.
MeshedBodies make_nodes(const std::vector<Mesh>& bodies, double density, double spacing = 1.0,
                        const Box<2>& box = {});

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../common.hpp"
#include <spam/rhs/elements.hpp>

namespace mesh_modes {

using namespace spam;

/// Velocities of a mesh that change the shape of no element's average: s = (-1)^(i + j) of node i, j.
enum class Mode {
    hourglass_x,  ///< (s, 0)
    hourglass_y,  ///< (0, s)
    butterfly  ///< s (x, -y): elements of the two colours of a chequerboard turn against each other
};
std::string_view to_string(Mode mode);

/// n x n square elements of side 1 about the origin, elastic, with lambda = eta = sqrt(3/16).
std::unique_ptr<ParticleModel<2>> make_mesh(int n, const HourglassControl& control);

/// The largest is 1. 2 x nodes.
Points<2> velocities(const ParticleModel<2>& mesh, Mode mode);

/// The largest rate of stress of the mesh at rest under these velocities.
double stress_rate(ParticleModel<2>& mesh, const Points<2>& v);

/// By how much each element turns under small displacements of the nodes.
std::vector<double> turns(const ParticleModel<2>& mesh, const Points<2>& displacement);

/// Directions of the velocities of all nodes under which no stress changes, rigid motions left out: the dimension
/// of the null space of what the right-hand side makes of velocities, whose singular values fall from about 1
/// to rounding errors. Returns 0 <= modes; `gap`: the least of the former over the largest of the latter.
struct ZeroModes {
    int count;
    double gap;
};
ZeroModes zero_modes(ParticleModel<2>& mesh);

}  // namespace mesh_modes

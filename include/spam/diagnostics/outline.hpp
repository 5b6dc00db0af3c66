// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>

#include <vector>

namespace spam {

/// Particles on the surface of a plane lattice body, in order around its centre: those with fewer
/// neighbours within 1.2 spacings than the best-connected particle has. For bodies without holes
/// whose surface every ray from the centre meets once (hexagons, disks, plates).
/// Joined by lines, their later positions show how the body's outline moved.
std::vector<Eigen::Index> outline(const Points<2>& reference, double spacing);

}  // namespace spam

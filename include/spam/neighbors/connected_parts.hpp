// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>

#include <cstdint>
#include <vector>

namespace spam {

/// Bodies: the connected parts of a set of particles, two particles belonging together when they
/// are closer than `reach` (or linked by a chain of such pairs). Returns for each particle the
/// number of its body, 0, 1, ... in the order of each body's first particle.
template <int Dim>
std::vector<std::int32_t> connected_parts(const Points<Dim>& position, double reach,
                                          const Box<Dim>& box);

}  // namespace spam

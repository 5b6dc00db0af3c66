// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/neighbors/box.hpp>

namespace spam {

/// How far a body is from a rigid motion of its reference shape: the root mean square distance of
/// the particles from the best-fit rotation and translation of `reference` (Kabsch; reflections
/// excluded), divided by `spacing`. Positions Dim x N, unwrapped.
template <int Dim>
double shape_error(const Points<Dim>& reference, const Points<Dim>& position, double spacing);

/// Distance of the closest two particles, infinity for fewer than two. `reach` is a first guess of
/// where to look; it grows until a pair is found.
template <int Dim>
double closest_pair(const Points<Dim>& position, double reach, const Box<Dim>& box);

}  // namespace spam

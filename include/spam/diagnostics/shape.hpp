// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/diagnostics/history.hpp>
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

/// How long a body keeps its shape: the first time, among the rows of `history`, at which its columns
/// have shape_error >= 0.5 or closest_pair <= 0.3 spacings (or neither number), the last time where
/// none has. Spacing 1.
double time_survived(const History& history);

}  // namespace spam

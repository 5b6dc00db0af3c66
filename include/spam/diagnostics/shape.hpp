// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/diagnostics/history.hpp>
#include <spam/neighbors/box.hpp>

#include <string_view>

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

/// The part of the particles with another one nearer than `distance`.
template <int Dim>
double clumped_fraction(const Points<Dim>& position, double distance, const Box<Dim>& box);

/// How long a body kept its shape, and how it lost it.
struct Survival {
    double t;              ///< of the first row without it; of the last one where it was kept
    bool whole;            ///< kept to the end
    std::string_view end;  ///< "whole", "deformed", "clumped", "clumped and deformed"
};

/// From the rows of a history with columns `shape_error` and `closest_pair`: deformed is an error of half
/// a spacing, clumped a pair nearer than 0.3 spacings (or neither a number). Spacing 1.
Survival survival(const History& history);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>

#include <span>

namespace spam {

/// How far a plane body is from round, seen as a square:
///     |<r^4 cos 4 theta>|/<r^4>,
/// r and theta from the centre of mass, averages by mass. Zero for a disk, 3/7 for a square filled
/// evenly, with its sides along the axes or at 45 degrees to them. `position` 2 x N, `mass` N; NaN where
/// all is in one place.
double fourfold_moment(const Points<2>& position, std::span<const double> mass);

}  // namespace spam

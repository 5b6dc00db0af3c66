// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>

/// The longest step beside sides that move, of particles whose spacing is 1: the fastest side moves by .6 spacings in
/// it, and particles hardly pass each other (tests/problem/flows.cpp). Infinite where no side moves.
template <int Dim>
double step_beside_walls(const spam::Box<Dim>& box) {
    return 0.6 / box.fastest_wall();
}

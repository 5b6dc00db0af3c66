// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace spam {

/// A box with sides along the axes.
template <int Dim>
struct Bounds {
    double centre[Dim];
    double half[Dim];  ///< of the lengths of the sides
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace spam {

/// Of the latest rates of a term the part that is due to the images behind one wall.
template <int Dim>
struct WallRates {
    int axis = 0;        ///< the wall across this direction,
    bool upper = false;  ///< the lower or the upper one
    /// Numbers, among those of the term, of the particles that may have images behind it for neighbours;
    /// ascending.
    std::vector<std::uint32_t> particle{};
    std::vector<std::uint32_t> place{};  ///< where the rates of particle[k] are
    std::vector<double> v_dot{};         ///< Dim a place
    std::vector<double> e_dot{};         ///< one a place
};

}  // namespace spam

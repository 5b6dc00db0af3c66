// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace spam {

/// The image of a particle that sweeps see: as many periods away from the position in y as when their list
/// was built. Plain numbers: it is also compiled into *.lanes.cpp.
template <int Dim>
struct Home {
    const std::int32_t* periods = nullptr;  ///< Dim x N; null where nothing is periodic
    double length[Dim] = {};
    double last_place[Dim] = {},
           places[Dim] = {};  ///< the period's (box.hpp) and its inverse; 0 where free

    /// Coordinate a of particle i. Exact from the rounding on: what is taken off is a multiple of the
    /// place, and so is what is left, which a double holds.
    [[gnu::always_inline]] double operator()(std::size_t i, std::size_t a, double x) const {
        if (places[a] == 0.0) return x;
        const double rounded = __builtin_nearbyint(x * places[a]) * last_place[a];
        return __builtin_fma(-static_cast<double>(periods[Dim * i + a]), length[a], rounded);
    }
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace spam {

/// Whether a particle has moved too far for a list, a rigid motion taken off:
/// |x - (shift + rotation x_then)|^2 <= limit^2 does not hold. For a loop that reads the positions
/// anyway. Plain numbers: it is also compiled into *.lanes.cpp.
template <int Dim>
struct Displacement {
    double rotation[Dim][Dim];
    double shift[Dim];
    const double* then;  ///< Dim x N
    double limit2;

    /// `now`: Dim, of particle i. 1 for yes, also where x is not a number.
    [[gnu::always_inline]] std::size_t too_far(std::size_t i, const double* now) const {
        double d2 = 0.0;
        for (std::size_t a = 0; a < Dim; ++a) {
            double d = now[a] - shift[a];
            for (std::size_t b = 0; b < Dim; ++b) d -= rotation[a][b] * then[Dim * i + b];
            d2 += d * d;
        }
        return static_cast<std::size_t>(!(d2 <= limit2));
    }
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/lanes.hpp>

namespace spam {
inline namespace SPAM_LANES {

/// The g of PlaneStressVonMises for a yield stress Y + c g q, by Newton's method for 1/q = (1 - c g)/Y: of a pure
/// shear and of a pure mean stress both sides are linear in g, so that a few steps do. With A = 1 + a g,
/// B = 1 + b g and N = (A B q)^2 = p2 B^2 + s2 A^2 a step takes one root and one quotient. T: double, or lanes.
template <class T>
struct PlaneStressMultiplier {
    T p2, s2, Y;
    double a, b, c;
    T g = 0.0;
    int steps = 0;

    /// Whether another step is needed: not if the last one was so small that its square is rounding error.
    SPAM_INLINE bool advance() {
        const T A = 1.0 + a * g, B = 1.0 + b * g, p = p2 * B * B, s = s2 * A * A;
        const T N = p + s, NS = N * sqrt_by_products(N);
        const T step =
            ((1.0 - c * g) * NS - Y * A * B * N) / (Y * (a * p * B + b * s * A) + c * NS);
        g += step;
        // A NaN ends the search.
        return ++steps < 50 && lanes_below(T(1e-18) * g * g, step * step) != 0;
    }
};

}  // namespace SPAM_LANES
}  // namespace spam

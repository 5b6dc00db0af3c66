// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>

namespace spam {

/// A weight function w(r), normalised to one over the line, plane or space, zero from the range h
/// on. `value` gives w, `minus_slope_over_r` gives -w'/r (finite at r = 0, so that grad_i w_ij =
/// -(w'/r) (r_j - r_i) needs no division), both as templates of the arithmetic type. Beyond h both must come out
/// as exact zeros without a branch: lists hold neighbours a little beyond the range.
template <class W>
concept WeightFunction = requires(const W w, double r) {
    { w.range() } -> std::convertible_to<double>;
    { w.value(r) } -> std::convertible_to<double>;
    { w.minus_slope_over_r(r) } -> std::convertible_to<double>;
};

}  // namespace spam

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

/// One that also gives w'' and w''' (in double: for set-up, pictures and potentials of the density;
/// zero from the range on, one-sided where they jump) and says how smooth it is:
/// `continuous_derivatives` counts those of w(r) that are continuous for all r > 0. At r = 0 every
/// one here begins with r^2 and |r|^3, so that in space the third derivatives jump there.
template <class W>
concept SmoothWeightFunction = WeightFunction<W> && requires(const W w, double r) {
    { w.second_derivative(r) } -> std::same_as<double>;
    { w.third_derivative(r) } -> std::same_as<double>;
    { W::continuous_derivatives } -> std::convertible_to<int>;
};

/// w'' + (Dim - 1) w'/r
template <int Dim, SmoothWeightFunction W>
double laplacian(const W& w, double r) {
    return w.second_derivative(r) - (Dim - 1) * w.minus_slope_over_r(r);
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/kernel/any_weight.hpp>

namespace spam {

/// <r^power> = integral of w r^power over the line, plane or space, to rounding errors; power >= 0. 1 for the power 0;
/// the mean square of Lucy's in the plane is 5 h^2/28.
template <int Dim>
double moment(const AnyWeight<Dim>& weight, int power);

/// The largest factor by which a gradient sum multiplies a wave, in the continuum: the maximum over k of
/// integral of (-w'(r)/r) x sin kx. It stands for the wave number of the shortest waves that smooth
/// particles feel; about 2/h to 3/h.
template <int Dim>
double steepest_wave(const AnyWeight<Dim>& weight);

/// The fastest rate at which diffusion by such sums with the coefficient 1 smooths a wave, in the continuum:
/// the maximum over k of k integral of (-w'(r)/r) x sin kx = k^2 W(k), W the transform of w.
template <int Dim>
double fastest_diffusion(const AnyWeight<Dim>& weight);

/// By what a time step that resolves the fastest waves of `standard` must be multiplied for `weight`: the quotient
/// of their steepest waves, at most 1. The frequencies of sound go with these.
template <int Dim>
double relative_step(const AnyWeight<Dim>& weight, const AnyWeight<Dim>& standard);

/// The mean of w over the straight line from `a` to `b`, as seen from where the weight function has its centre: Hardy's
/// bond function. To rounding errors.
template <int Dim>
double mean_along(const AnyWeight<Dim>& weight, const Point<Dim>& a, const Point<Dim>& b);

}  // namespace spam

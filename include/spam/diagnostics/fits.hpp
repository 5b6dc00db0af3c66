// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace spam {

/// Least-squares line y = intercept + slope x (GSL), with the standard error of the slope.
struct LineFit {
    double intercept;
    double slope;
    double slope_error;
};

/// x and y of equal length, at least three points, not all x equal.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

/// The factor c that makes c `to` nearest to `of` in the sense of least squares.
double best_factor(std::span<const double> of, std::span<const double> to);

/// Period of an oscillation about zero: twice the slope of a line through the times at which it
/// changes sign (linear between rows; a zero in row 0 does not count). 0 with fewer than three.
double period_of_zeros(std::span<const double> t, std::span<const double> value);

/// Whether rows at these times are close enough to tell such a period: twenty of them or more.
bool resolves(std::span<const double> t, double period);

/// Observed order of convergence: slope of log error against log step.
double observed_order(std::span<const double> step, std::span<const double> error);

}  // namespace spam

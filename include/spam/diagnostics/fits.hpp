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

/// Observed order of convergence: slope of log error against log step.
double observed_order(std::span<const double> step, std::span<const double> error);

}  // namespace spam

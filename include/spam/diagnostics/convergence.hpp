// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace spam {

/// Order of a method as runs with smaller and smaller steps show it.
struct ConvergenceFit {
    double order = 0.0;        ///< slope of log error against log step
    double order_error = 0.0;  ///< its standard error
    double largest_step = 0.0, smallest_step = 0.0;
    std::size_t points = 0;  ///< in that range; 0: no range serves, nothing is known

    bool known() const { return points > 0; }
};

/// What counts as the range of steps in which an order shows.
struct ConvergenceRule {
    double above_floor = 100.0;  ///< errors at least this many times the floor
    double below = 1e-2;         ///< errors at most this: larger ones are not asymptotic
    double spread = 0.15;        ///< slopes between neighbours from their mean
    std::size_t points = 4;      ///< at least
    double span = 2.0;           ///< largest over smallest step, at least
};

/// Fits error ~ step^order where errors tell it. The range begins at the smallest step whose error is
/// far enough above `floor` (round-off, or what the reference is known to) and whose slope agrees with
/// the next one; it takes in larger steps as long as the error is small enough and the slope between
/// neighbours stays within `spread` of the mean of those before. The nominal order does not enter.
/// Steps descending; what is not finite ends a range.
ConvergenceFit fit_convergence(std::span<const double> step, std::span<const double> error,
                               double floor, const ConvergenceRule& rule = {});

/// How a drift grows: its envelope (the largest change so far) as a power of time.
struct GrowthFit {
    double exponent = 0.0;
    double largest = 0.0;  ///< change in all the time
    bool above_round_off = false;

    /// "bounded" (exponent below 0.25), "random walk" (below 0.75), "secular"; "round-off" where the
    /// largest change tells nothing else.
    std::string_view kind() const;
};

/// Fits envelope ~ t^exponent between a tenth of the time and its end, at times evenly spread in log t.
/// `change` is the change since t = 0 in units of the invariant's size; below `round_off` it is none of
/// the method's. Times ascending, at least ten of them.
GrowthFit fit_growth(std::span<const double> t, std::span<const double> change, double round_off);

}  // namespace spam

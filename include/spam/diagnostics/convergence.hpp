// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace spam {

/// Order of a method as runs with smaller and smaller steps show it.
struct ConvergenceFit {
    double order = 0.0;
    double order_error = 0.0;  ///< its standard error
    double largest_step = 0.0, smallest_step = 0.0;
    std::size_t points = 0;  ///< in that range; 0: no range serves, nothing is known

    bool known() const { return points > 0; }
};

/// Which range of steps shows an order.
struct ConvergenceRule {
    double above_floor;  ///< errors at least this many times the floor
    double below;        ///< errors at most this: larger ones tell nothing of small steps
    double spread;       ///< of slopes between neighbours from the mean of those at smaller steps
    std::size_t points;  ///< at least
    double span;         ///< largest over smallest step, at most

    /// For equations as smooth as the method wants: the smallest steps, four in factors of sqrt 2.
    static constexpr ConvergenceRule smooth() { return {30.0, 1e-2, 0.3, 4, 2.9}; }
    /// For others: slopes scatter, an average order is all there is.
    static constexpr ConvergenceRule rough() { return {10.0, 1e-2, 2.0, 5, 1e3}; }
};

/// Fits error ~ step^order where errors tell it. The range begins at the smallest step whose error is far enough
/// above `floor` (what the reference is known to, or round-off) and takes in larger steps as long as
/// the rule allows; where too few come together it begins one step later. The nominal order does not
/// enter. Steps descending; what is not finite ends a range.
ConvergenceFit fit_convergence(std::span<const double> step, std::span<const double> error,
                               double floor, const ConvergenceRule& rule);

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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace spam {

/// F(x) = 0 as a solver sees it, with a symmetric derivative; F and x of a size of about one. Fills F; false where
/// x has no meaning: a shorter step is tried.
using Residual = std::function<bool(std::span<const double> x, std::span<double> F)>;

struct RootOptions {
    double tolerance = 1e-10;  ///< of the largest |F|
    long most_steps = 50;      ///< of Newton's method
    double longest_step = 0;   ///< of x, its norm; 0: any
};

struct RootFound {
    std::vector<double> x;
    std::size_t steps = 0;
};

/// Newton's method with line search; its linear equations by conjugate gradients, no more exactly than a step needs
/// (KINSOL, Eisenstat and Walker's first choice). Derivatives along a vector are differences to one side, of one
/// more F: Newton's method mends what they are off by. Throws GuardStop, with KINSOL's words, where it does not
/// converge.
RootFound find_root(const Residual& residual, std::span<const double> start,
                    const RootOptions& options);

}  // namespace spam

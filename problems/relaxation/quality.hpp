// SPDX-License-Identifier: GPL-3.0-or-later
// How even particles in a region are.
#pragma once

#include "wall.hpp"

#include <vector>

namespace relaxation {

/// Densities are summed with Lucy's weight of range 3, whatever repels the particles.
class Ruler {
  public:
    explicit Ruler(const Region& region) : region_(region), wall_(region, range) {}

    static constexpr double range = 3.0;
    /// Neighbours are nearer: between the first and the second shell of a triangular lattice with one
    /// site per area, 1.07 and 1.86.
    static constexpr double next_shell = 1.47;

    /// With what the wall stands for.
    std::vector<double> density(const Points<2>& x) const;
    /// How many neighbours each has.
    std::vector<int> neighbours(const Points<2>& x) const;
    std::vector<double> distances_from_border(const Points<2>& x) const;
    int outside(const Points<2>& x) const;

  private:
    Region region_;
    OuterMatter wall_;
};

struct Quality {
    double scatter;   ///< standard deviation of the density, relative to its mean
    double interior;  ///< the same of the particles that do not see the border; NaN without such
    double nearest;   ///< mean distance of the nearest neighbour
    double six;       ///< part of the particles off the border that have six neighbours
    int outside;
};
Quality measure(const Ruler& ruler, const Points<2>& x);

/// Mean distance of the nearest other particle; infinite for one alone.
double mean_nearest(const Points<2>& x);

/// Relative standard deviation; NaN for fewer than two.
double scatter(const std::vector<double>& values);

}  // namespace relaxation

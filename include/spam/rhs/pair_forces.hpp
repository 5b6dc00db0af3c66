// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace spam {

/// What two particles exchange: an energy, and a force along the line that joins them.
template <int Dim>
struct PairForce {
    std::size_t i, j;     ///< by their numbers in the model
    Point<Dim> r_ij;      ///< from j to i, the images that act on each other
    double energy;        ///< of the pair
    double force_over_r;  ///< F/r: the force on i is this times r_ij, that on j the opposite
};

/// Of a term whose forces may be those of pairs: all of these, in any state.
template <int Dim>
class ForcesOfPairs {
  public:
    virtual ~ForcesOfPairs() = default;
    /// Every pair within reach once, without images behind walls; nothing where a law does not tell (friction, laws
    /// of the user's own). Throws InputError where several images of a particle may be within reach.
    virtual std::optional<std::vector<PairForce<Dim>>> pair_forces(
        std::span<const double> y) const = 0;
};

}  // namespace spam

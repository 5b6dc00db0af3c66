// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/neighbors/bounds.hpp>

#include <array>
#include <vector>

namespace spam {

/// Bounds of clusters.
template <int Dim>
class ClusterBoxes {
  public:
    /// Coordinates by slot, of that many full clusters.
    void build(const std::array<std::vector<double>, Dim>& x, std::size_t width,
               std::size_t clusters);

    /// Whether few clusters are much larger than most.
    bool alike() const;

    std::size_t size() const { return bounds_.size(); }
    const Bounds<Dim>& operator[](std::size_t cluster) const { return bounds_[cluster]; }
    /// Of the space between bounds that are `reach` wider on every side.
    static double volume(const Bounds<Dim>& bounds, double reach) {
        double volume = 1.0;
        for (std::size_t a = 0; a < Dim; ++a) volume *= 2.0 * (bounds.half[a] + reach);
        return volume;
    }

    /// Mean number of places that a cluster's list has to look at, at unit density.
    double mean_volume(double reach) const;
    /// The same as a harmonic mean, to which the few that are large do not count.
    double typical_volume(double reach) const;

  private:
    std::vector<Bounds<Dim>> bounds_;
};

SPAM_COMPILED(extern template class ClusterBoxes);

}  // namespace spam

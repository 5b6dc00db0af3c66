// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spam {

/// Particles sorted so that neighbours in space are neighbours in memory: strips (columns in three
/// dimensions) across all directions but the last, sorted by the last coordinate inside a strip,
/// upwards and downwards in turn, so that the end of one strip is next to the beginning of the
/// following one. A slot is a place in this order. Any few particles that follow each other then
/// fill a compact piece of space.
template <int Dim>
class StripSort {
  public:
    /// Positions Dim x N, finite; strips begin at the border of the box where it is periodic. They are as wide
    /// as the share of space of six particles is on a side: right for clusters of four and of eight.
    /// Particles flung far apart would need more bins than particles: these grow instead, which
    /// costs time, never memory. Up to `unsorted` particles of one bin, which hold about one, stay as their
    /// numbers are: with a few the order is as good for neighbours, and made faster.
    void build(const Points<Dim>& position, const Box<Dim>& box, std::uint32_t unsorted = 1);

    /// order()[slot] is the particle's number. Ties keep the lower number first.
    std::span<const std::uint32_t> order() const { return order_; }
    /// The share of space of a particle, roughly.
    double volume() const { return volume_; }

  private:
    using Int = std::int32_t;

    Int bin(std::size_t a, double x) const;
    void choose_bins(const Points<Dim>& position, const Box<Dim>& box);
    double volume_per_particle(const Points<Dim>& position);
    void divide(std::size_t a, double edge);
    struct Sequence;
    void sort_bin(std::size_t b, const Points<Dim>& position, double sign);

    std::array<double, Dim> origin_{}, extent_{}, per_edge_{};
    std::array<Int, Dim> count_{};
    double volume_ = 1.0;  ///< per particle
    Eigen::Index volume_of_ = 0;
    std::size_t sorted_ = 0;
    std::vector<std::uint32_t> order_, start_, bin_of_;
};

SPAM_COMPILED(extern template class StripSort);

}  // namespace spam

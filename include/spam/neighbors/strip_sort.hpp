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

    /// Bins of direction a: where they begin, how wide they are (0 where all is at one place), how many
    /// there are.
    double origin(std::size_t a) const { return origin_[a]; }
    double edge(std::size_t a) const { return per_edge_[a] > 0.0 ? 1.0 / per_edge_[a] : 0.0; }
    std::size_t bins(std::size_t a) const { return static_cast<std::size_t>(count_[a]); }
    /// The share of space of a particle, roughly.
    double volume() const { return volume_; }

    /// visit(first, last): ranges of slots, ascending, that together hold every particle between the
    /// corners `low` and `high` (and some around).
    template <class Visit>
    void for_each_range(const Point<Dim>& low, const Point<Dim>& high, const Visit& visit) const {
        std::array<std::array<Int, 2>, Dim> bins;
        for (std::size_t a = 0; a < Dim; ++a)
            bins[a] = {bin(a, low[static_cast<Eigen::Index>(a)]),
                       bin(a, high[static_cast<Eigen::Index>(a)])};
        visit_axis<0>(bins, 0, visit);
    }

  private:
    using Int = std::int32_t;

    Int bin(std::size_t a, double x) const;
    void choose_bins(const Points<Dim>& position, const Box<Dim>& box);
    double volume_per_particle(const Points<Dim>& position);
    void divide(std::size_t a, double edge);
    struct Sequence;
    void sort_bin(std::size_t b, const Points<Dim>& position, double sign);

    /// `sequence`: number of the strip so far; in odd ones the next direction runs backwards.
    template <int Axis, class Visit>
    void visit_axis(const std::array<std::array<Int, 2>, Dim>& bins, Int sequence,
                    const Visit& visit) const {
        const Int n = count_[Axis];
        const bool backwards = sequence % 2 != 0;
        const auto [first, last] = bins[Axis];
        const Int begin = sequence * n + (backwards ? n - 1 - last : first);
        const Int end = begin + (last - first);
        if constexpr (Axis + 1 < Dim) {
            for (Int s = begin; s <= end; ++s) visit_axis<Axis + 1>(bins, s, visit);
        } else {
            visit(start_[static_cast<std::size_t>(begin)],
                  start_[static_cast<std::size_t>(end) + 1]);
        }
    }

    std::array<double, Dim> origin_{}, extent_{}, per_edge_{};
    std::array<Int, Dim> count_{};
    double volume_ = 1.0;  ///< per particle
    Eigen::Index volume_of_ = 0;
    std::size_t sorted_ = 0;
    std::vector<std::uint32_t> order_, start_, bin_of_;
};

extern template class StripSort<1>;
extern template class StripSort<2>;
extern template class StripSort<3>;

}  // namespace spam

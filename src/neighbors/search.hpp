// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>
#include <spam/neighbors/bounds.hpp>
#include <spam/neighbors/cluster_cells.hpp>
#include <spam/neighbors/cluster_view.hpp>

namespace spam {

/// Where a cluster list searches: coordinates by slot.
template <int Dim>
struct SearchInput {
    const double* x[Dim];
    double cutoff2;
    std::uint32_t stride;
};

/// Slots that clusters choose their neighbours from (ClusterCells), and how: coordinates are (x - middle)
/// scale, the reach is in their units and a little more for their rounding.
template <int Dim>
struct Candidates {
    static constexpr std::size_t lanes = ClusterCells<Dim>::lanes;
    const float* x[Dim];
    const std::uint32_t* slots;
    std::size_t count;
    const std::array<float, 2 * Dim>*
        chunks;  ///< of ClusterCells; none where numbers have been left out
    double middle[Dim];
    double scale, reach;
};

/// The parts of a search that are compiled for every instruction set.
template <int Dim>
struct Search {
    /// Looks among some slots for those within the cutoff of any particle of the cluster that begins at
    /// `first_slot` (`members` of its lanes count); writes them times `stride` in the order given, adds the
    /// number of pairs found, returns the end of what it wrote. There must be room for all.
    std::uint32_t* (*near_members)(const SearchInput<Dim>&, std::size_t first_slot,
                                   unsigned members, const std::uint32_t* slots, std::size_t count,
                                   std::uint32_t* out, std::size_t& pairs);

    /// Copies the candidates between two corners, in their order, to x and slots; these must have room for all
    /// and `lanes` more. Returns how many.
    std::size_t (*narrow)(const Candidates<Dim>&, const float* low, const float* high,
                          float* const* x, std::uint32_t* slots);
    /// All candidates closer than the reach to the bounds, times `factor`, in their order: some more than
    /// the members' neighbours, found many times as fast. May write a register's width too much.
    std::uint32_t* (*near_bounds)(const Candidates<Dim>&, const Bounds<Dim>&, std::uint32_t factor,
                                  std::uint32_t* out);
};

/// For clusters of `width`. Defined in search.lanes.cpp for every level.
template <int Dim, InstructionSet Level>
Search<Dim> search_for(int width);

}  // namespace spam

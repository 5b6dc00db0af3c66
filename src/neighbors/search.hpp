// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>
#include <spam/neighbors/bounds.hpp>
#include <spam/neighbors/cluster_view.hpp>

namespace spam {

/// Where a cluster list searches: coordinates by slot.
template <int Dim>
struct SearchInput {
    const double* x[Dim];
    double cutoff2;
    double reach2;              ///< a little more than cutoff2, for bounds
    std::size_t slots;          ///< beyond them particles are repeated
    const Bounds<Dim>* bounds;  ///< by cluster
    std::uint32_t stride;
};

/// The parts of a search that are compiled for every instruction set.
template <int Dim>
struct Search {
    /// Keeps of the clusters numbered ids[0..count), in their order, those closer than the reach to the
    /// bounds; may write to where it reads. Returns how many.
    std::size_t (*keep_near)(const SearchInput<Dim>&, const Bounds<Dim>&, const std::uint32_t* ids,
                             std::size_t count, std::uint32_t* kept);

    /// Looks in ranges of slots for those within the cutoff of any particle of the cluster that begins
    /// at `first_slot` (`members` of its lanes count); writes them times `stride` in the order given,
    /// adds the number of pairs found, returns the end of what it wrote. There must be room for all.
    std::uint32_t* (*in_ranges)(const SearchInput<Dim>&, std::size_t first_slot, unsigned members,
                                const SlotRange* ranges, std::size_t count, std::uint32_t* out,
                                std::size_t& pairs);
    /// The same in the slots of clusters.
    std::uint32_t* (*in_clusters)(const SearchInput<Dim>&, std::size_t first_slot, unsigned members,
                                  const std::uint32_t* ids, std::size_t count, std::uint32_t* out,
                                  std::size_t& pairs);

    /// All slots in the ranges that are closer than the reach to the bounds: some more than the
    /// members' neighbours, found several times as fast. May write a register's width too much, and
    /// reads as much beyond the last slot.
    std::uint32_t* (*around_bounds)(const SearchInput<Dim>&, const Bounds<Dim>&,
                                    const SlotRange* ranges, std::size_t count, std::uint32_t* out);
};

/// For clusters of `width`. Defined in search.lanes.cpp for every level.
template <int Dim, InstructionSet Level>
Search<Dim> search_for(int width);

}  // namespace spam

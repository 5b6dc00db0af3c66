// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>
#include <spam/neighbors/cluster_view.hpp>

namespace spam {

/// Where a cluster list searches: coordinates by slot, and the box.
template <int Dim>
struct SearchInput {
    const double* x[Dim];
    double length[Dim];   ///< zero where free
    double inverse[Dim];  ///< of length, likewise
    double cutoff2;
    bool wraps;  ///< periodic in some direction
};

/// Looks among candidate slots for those within the cutoff of any particle of the cluster that
/// begins at `first_slot` (`members` of its lanes count); writes them in the order given, adds the number of pairs found, returns
/// the end of what it wrote. There must be room for all candidates.
template <int Dim>
using Search = std::uint32_t* (*)(const SearchInput<Dim>&, std::size_t first_slot, unsigned members,
                                  const SlotRange* candidates, int count, std::uint32_t* out,
                                  std::size_t& pairs);

/// For clusters of `width`. Defined in search.lanes.cpp for every level.
template <int Dim, InstructionSet Level>
Search<Dim> search_for(int width);

}  // namespace spam

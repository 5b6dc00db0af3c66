// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

/// How far sweeps over pairs look ahead in their lists: a matter of the processor, as the instruction set is. No
/// bit of a result depends on it.
namespace spam {

/// Distances are found at most this many neighbours before what is summed over them.
inline constexpr std::size_t most_neighbours_ahead = 4;

/// How many: `most_neighbours_ahead`, which was quickest on the one processor that was measured
/// (tests/bench/README.md), or what the environment variable SPAM_AHEAD names (1, 2, 4). Settled by the first call.
/// Throws InputError if SPAM_AHEAD is something else.
std::size_t neighbours_ahead();

/// For tests, between right-hand sides: 1, 2 or 4 from now on. Returns the number before.
std::size_t set_neighbours_ahead(std::size_t ahead);

/// Records of neighbours are brought into the nearest cache this many entries of a list before they are read. Entries
/// follow each other from cluster to cluster; behind the last one of a block of memory are this many more, which name
/// any record.
inline constexpr std::size_t entries_ahead = 64;

}  // namespace spam

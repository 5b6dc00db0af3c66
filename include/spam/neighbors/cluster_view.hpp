// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace spam {

/// What a sweep reads of a cluster list: plain pointers, because sweeps are compiled for several
/// instruction sets and must leave no function behind that other code could be linked to.
struct ClusterView {
    struct Entries {
        const std::uint32_t*
            first;  ///< where the records of neighbours begin; `entries_ahead` more may be read
        std::uint32_t count;
    };

    std::size_t particles;
    std::size_t clusters;
    const std::uint32_t* order;  ///< slot -> particle; the last one repeated to fill lanes
    const Entries* entries;      ///< by cluster
};

/// Records of all particles by slot: `stride` numbers each, of which a sweep reads the first.
struct Records {
    const double* numbers;
    std::size_t stride;
};

}  // namespace spam

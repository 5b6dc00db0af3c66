// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>

#include <cstdint>
#include <random>

namespace spam {

/// A number even between 0 and 1 (never 1), the same with every library: the standard fixes the
/// generator's numbers, not what its distributions make of them.
inline double drawn(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Moves every coordinate by up to `most` in either direction, evenly, by numbers of this seed.
template <int Dim>
void displace(Points<Dim>& position, double most, int seed) {
    if (!(most > 0.0)) return;
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    for (double& x : position.reshaped()) x += most * (2.0 * drawn(random) - 1.0);
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>

namespace spam {

/// A number even between 0 and 1 (never 1), the same with every library: the standard fixes the
/// generator's numbers, not what its distributions make of them.
inline double drawn(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

}  // namespace spam

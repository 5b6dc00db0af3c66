// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace spam {

/// Fewer particles than this are faster on one thread than the fork and join cost.
inline constexpr std::size_t parallel_threshold = 1000;

/// body(i) for i in [0, n). Each i must write only what belongs to i: then the result has the same
/// bits with any number of threads.
template <class Body>
void parallel_for(std::size_t n, const Body& body) {
#pragma omp parallel for schedule(static) if (n >= parallel_threshold)
    for (std::size_t i = 0; i < n; ++i) body(i);
}

/// Number of threads later sweeps use; 0 keeps the runtime's default. Returns the number in force.
int set_threads(int threads);

}  // namespace spam

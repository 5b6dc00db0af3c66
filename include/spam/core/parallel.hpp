// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace spam {

/// Fewer particles than this are faster on one thread than the fork and join cost.
inline constexpr std::size_t parallel_threshold = 1000;

/// body(i) for i in [0, n), each worth `weight` particles of work. Each i must write only what
/// belongs to i: then the result has the same bits with any number of threads.
template <class Body>
void parallel_for(std::size_t n, const Body& body, std::size_t weight = 1) {
    if (n * weight < parallel_threshold) {  // not an if clause: that still sets up a team
        for (std::size_t i = 0; i < n; ++i) body(i);
        return;
    }
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) body(i);
}

/// body(first, count) for blocks of 0, ..., n - 1, the same blocks for any number of threads.
template <class Body>
void parallel_blocks(std::size_t n, const Body& body) {
    constexpr std::size_t block = 512;
    parallel_for(
        (n + block - 1) / block,
        [&](std::size_t b) { body(b * block, n - b * block < block ? n - b * block : block); },
        block);
}

/// Sum of count(i), a whole number.
template <class Count>
std::size_t parallel_count(std::size_t n, const Count& count, std::size_t weight = 1) {
    std::size_t sum = 0;
    if (n * weight < parallel_threshold) {
        for (std::size_t i = 0; i < n; ++i) sum += count(i);
        return sum;
    }
#pragma omp parallel for schedule(static) reduction(+ : sum)
    for (std::size_t i = 0; i < n; ++i) sum += count(i);
    return sum;
}

/// Number of threads later sweeps use; 0 keeps the runtime's default. Returns the number in force.
int set_threads(int threads);

}  // namespace spam

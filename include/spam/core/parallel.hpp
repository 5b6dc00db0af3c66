// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>

namespace spam {

/// Fewer particles than this are done sooner by one thread than shared among several.
inline constexpr std::size_t parallel_threshold = 1000;

/// A loop that several threads share, each of them for other ranges of it.
class SharedLoop {
  public:
    virtual void run(std::size_t first, std::size_t last) const = 0;

  protected:
    ~SharedLoop() = default;
};

/// Calls run() for ranges that make up [0, n), on the threads that set_threads() asks for; which thread has which range
/// depends on the clock. Every thread begins with a share of its own, which is the same for the same n, and then helps
/// the others: a thread that another program keeps waiting holds up no more than the range it is in. Within such a
/// loop, and beside one of another thread, it is a plain loop. What run() throws first is thrown again.
void share(std::size_t n, const SharedLoop& loop);

/// range(first, last) for ranges that make up [0, n), each i worth `weight` particles of work; of less than
/// parallel_threshold on the calling thread alone, in one.
template <class Range>
void parallel_ranges(std::size_t n, const Range& range, std::size_t weight = 1) {
    class Loop final : public SharedLoop {
      public:
        explicit Loop(const Range& range) : range_(range) {}
        void run(std::size_t first, std::size_t last) const override { range_(first, last); }

      private:
        const Range& range_;
    };
    if (n * weight < parallel_threshold)
        range(0, n);
    else
        share(n, Loop(range));
}

/// body(i) for i in [0, n), each worth `weight` particles of work. Each i must write only what
/// belongs to i: then the result has the same bits with any number of threads.
template <class Body>
void parallel_for(std::size_t n, const Body& body, std::size_t weight = 1) {
    parallel_ranges(
        n,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) body(i);
        },
        weight);
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
    std::atomic<std::size_t> sum = 0;
    parallel_ranges(
        n,
        [&](std::size_t first, std::size_t last) {
            std::size_t of_range = 0;
            for (std::size_t i = first; i < last; ++i) of_range += count(i);
            sum += of_range;
        },
        weight);
    return sum;
}

/// Number of threads of later loops that the calling thread begins; 0 leaves it as it is, which at first is as many as
/// there are usable cores (core/threads.hpp). Returns the number in force.
int set_threads(int threads);

/// The same, and starts them. Throws InputError where they cannot be had; loops then do with those that there are.
void start_threads(int threads);

}  // namespace spam

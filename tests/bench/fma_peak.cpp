// SPDX-License-Identifier: GPL-3.0-or-later
#include "fma_peak.hpp"

#include <spam/core/instruction_set.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace spam::bench {
namespace {

constexpr std::size_t repeats = 200000;
constexpr std::size_t chains = 12;  // enough to fill two units of a latency of four or five

typedef double Two __attribute__((vector_size(16)));
typedef double Four __attribute__((vector_size(32)));
typedef double Eight __attribute__((vector_size(64)));

template <class Register>
[[gnu::always_inline]] inline double run() {
    const Register a = Register{} + 0.999999, b = Register{} + 1e-6;
    Register x[chains];
    for (std::size_t k = 0; k < chains; ++k) x[k] = Register{} + 1.0 + 0.01 * double(k);
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t n = 0; n < repeats; ++n)
#pragma GCC unroll 12
        for (std::size_t k = 0; k < chains; ++k) x[k] = x[k] * a + b;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    Register sum{};
    for (std::size_t k = 0; k < chains; ++k) sum += x[k];
    double first = sum[0];
    benchmark::DoNotOptimize(first);
    return 2.0 * double(repeats * chains * sizeof(Register) / sizeof(double)) / seconds.count();
}

#if defined(__x86_64__)
[[gnu::target("avx512f")]] double eight() { return run<Eight>(); }
[[gnu::target("avx2,fma")]] double four() { return run<Four>(); }
#endif
double two() { return run<Two>(); }

}  // namespace

double fma_peak() {
    double best = 0.0;
    for (int k = 0; k < 20; ++k) {
#if defined(__x86_64__)
        if (instruction_set() == InstructionSet::v4)
            best = std::max(best, eight());
        else if (instruction_set() == InstructionSet::v3)
            best = std::max(best, four());
        else
#endif
            best = std::max(best, two());
    }
    return best;
}

}  // namespace spam::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// What the layout of y costs where records are packed from it (10 numbers a particle: x, v, rho,
// sigma, e, m): a block for each field, as it is, or a row for each particle; in order and shuffled.
//   pack_blocks/N, pack_rows/N, pack_blocks_shuffled/N, pack_rows_shuffled/N
#include "systems.hpp"

#include <algorithm>
#include <numeric>
#include <random>

namespace spam::bench {
namespace {

constexpr std::size_t in_row = 9, in_record = 9;  // x, v, rho, sigma, e; x, v, m, rho, A

struct Order {
    std::vector<std::uint32_t> of;
    Order(std::size_t n, Given given) : of(n) {
        std::iota(of.begin(), of.end(), 0U);
        if (given == Given::shuffled) std::shuffle(of.begin(), of.end(), std::mt19937_64(5));
    }
};

template <class Read>
void pack(benchmark::State& state, Given given, const Read& read) {
    const auto n = static_cast<std::size_t>(state.range(0));
    const Order order(n, given);
    std::vector<double> y(in_row * n, 1.5), m(n, 1.0), records(in_record * n);
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) {
        for (std::size_t slot = 0; slot < n; ++slot) {
            const std::size_t i = order.of[slot];
            double* const record = &records[in_record * slot];
            double from[in_row];
            read(y.data(), n, i, from);
            const double scale = 1.0 / (from[4] * from[4]);
            for (std::size_t k = 0; k < 4; ++k) record[k] = from[k];
            record[4] = m[i];
            record[5] = from[4];
            for (std::size_t k = 0; k < 3; ++k) record[6 + k] = scale * from[5 + k];
        }
        benchmark::ClobberMemory();
    }
    state.counters["ns_per_particle"] =
        1e9 * watch.seconds() / static_cast<double>(state.iterations()) / static_cast<double>(n);
}

void from_blocks(const double* y, std::size_t n, std::size_t i, double* to) {
    to[0] = y[2 * i], to[1] = y[2 * i + 1];
    to[2] = y[2 * n + 2 * i], to[3] = y[2 * n + 2 * i + 1];
    to[4] = y[4 * n + i];
    for (std::size_t k = 0; k < 3; ++k) to[5 + k] = y[5 * n + 3 * i + k];
}
void from_row(const double* y, std::size_t, std::size_t i, double* to) {
    for (std::size_t k = 0; k < 8; ++k) to[k] = y[in_row * i + k];
}

void pack_blocks(benchmark::State& state) { pack(state, Given::in_order, from_blocks); }
void pack_rows(benchmark::State& state) { pack(state, Given::in_order, from_row); }
void pack_blocks_shuffled(benchmark::State& state) { pack(state, Given::shuffled, from_blocks); }
void pack_rows_shuffled(benchmark::State& state) { pack(state, Given::shuffled, from_row); }

}  // namespace

BENCHMARK(pack_blocks)->Apply(sizes);
BENCHMARK(pack_rows)->Apply(sizes);
BENCHMARK(pack_blocks_shuffled)->Apply(sizes);
BENCHMARK(pack_rows_shuffled)->Apply(sizes);

}  // namespace spam::bench

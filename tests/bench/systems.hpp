// SPDX-License-Identifier: GPL-3.0-or-later
// What the benchmarks are made on, and how they count.
#pragma once

#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace spam::bench {

inline constexpr Scheme monaghan{.transport = Transport::monaghan};

enum class Given { in_order, shuffled };

/// A hexagon of at least n particles of the paper's elastic solid, h = 3 spacings, jittered so that
/// no pair sits exactly at the range.
struct ElasticSystem {
    SmoothParticleModel<2> model;
    std::vector<double> y, y_dot;

    ElasticSystem(std::int64_t n, const Scheme& scheme, Given given = Given::in_order);
    void rates() { model.rates(0.0, y, y_dot); }
};

/// Lucy's weight function as pair potential, h = 6, in a periodic box. 20000: 132 x 152 particles of
/// triangular lattice, spacing 1; other numbers in about that shape. Velocities normal, `speed` a
/// component.
struct GasSystem {
    PairPotentialModel<2> model;
    std::vector<double> y, y_dot;

    GasSystem(std::int64_t n, double speed);
    void rates() { model.rates(0.0, y, y_dot); }
};

inline double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The least of `least` and the processor's seconds that body() takes, of all threads.
template <class Body>
double least_seconds(double least, const Body& body) {
    const double begin = processor_seconds();
    body();
    return std::min(least, processor_seconds() - begin);
}

/// Neighbours of a particle that are within the range, on average.
double neighbours_in_range(const Model<2>& model, std::span<const double> y);

/// Counters particles, ns_per_particle, ns_per_pair, pairs_per_second (undirected pairs within the
/// list) from the seconds of one call.
void count(benchmark::State& state, const Model<2>& model, double seconds_per_call);

/// 217 to 1,000,000.
void sizes(benchmark::internal::Benchmark* b);

/// Times system.rates().
template <class System>
void time_rates(benchmark::State& state, System& system) {
    system.rates();
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) system.rates();
    count(state, system.model, watch.seconds() / static_cast<double>(state.iterations()));
}

}  // namespace spam::bench

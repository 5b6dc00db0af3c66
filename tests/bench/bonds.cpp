// SPDX-License-Identifier: GPL-3.0-or-later
// The solid with material vectors: its right-hand sides in turn with those of the plain elastic solid on the same
// particles, and what it costs to change its table of bonds.
#include "systems.hpp"
#include <spam/core/parallel.hpp>
#include <spam/material/polynomial_solid.hpp>
#include <spam/rhs/material_vectors.hpp>

#include <algorithm>
#include <cmath>

namespace spam::bench {
namespace {

struct BondedSystem {
    MaterialVectorModel<2> model;
    std::vector<double> y, y_dot;

    explicit BondedSystem(const ElasticSystem& like)
        : model(like.model.particles(), PolynomialSolid{0.43, 0.43}, {.density = 1.15}) {
        const std::size_t n = model.particles().size();
        y.assign(like.y.begin(), like.y.begin() + static_cast<std::ptrdiff_t>(4 * n));
        y_dot.resize(y.size());
    }
    void rates() { model.rates(0.0, y, y_dot); }
};

/// Counters over_elastic (times the plain right-hand side) and ns_per_particle.
void material_vectors_over_elastic(benchmark::State& state) {
    set_threads(1);
    ElasticSystem elastic(state.range(0), monaghan);
    BondedSystem bonded(elastic);
    double plain = HUGE_VAL, own = HUGE_VAL;
    for ([[maybe_unused]] auto _ : state) {
        plain = least_seconds(plain, [&] { elastic.rates(); });
        own = least_seconds(own, [&] { bonded.rates(); });
    }
    state.counters["over_elastic"] = own / plain;
    state.counters["ns_per_particle"] =
        1e9 * own / static_cast<double>(bonded.model.particles().size());
}

/// After displacements back and forth, after which rows do not serve: with second argument 1 by half the skin and
/// more at random, so that every second particle meets another, with 0 by more than that along a long wave, as in a
/// body that bends: few do. Counter in_rates: times the right-hand side.
void material_vectors_update(benchmark::State& state) {
    set_threads(1);
    BondedSystem bonded(ElasticSystem(state.range(0), monaghan));
    const std::size_t n = bonded.model.particles().size();
    const double waves = 6.0 / std::sqrt(static_cast<double>(n));
    std::vector<double> moved = bonded.y;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t a = 0; a < 2; ++a)
            moved[2 * i + a] += state.range(1) != 0
                                    ? 0.12 * std::sin(1e4 * static_cast<double>(2 * i + a))
                                    : 0.4 * std::sin(waves * bonded.y[2 * i + 1 - a]);
    double update = HUGE_VAL, own = HUGE_VAL;
    for ([[maybe_unused]] auto _ : state) {
        std::swap(bonded.y, moved);
        update = least_seconds(update, [&] { bonded.model.settle(0.0, bonded.y); });
        bonded.rates();
        own = least_seconds(own, [&] { bonded.rates(); });
    }
    state.counters["in_rates"] = update / own;
    state.counters["ns_per_particle"] = 1e9 * update / static_cast<double>(n);
}

/// A body at work, by leapfrog with steps of 0.1: hot, and sheared so that its edges move at 0.45: some particle
/// meets or leaves another in every step. Counters in_rates: what all steps settle over all right-hand sides, one a
/// step; steps_per_update.
void material_vectors_at_work(benchmark::State& state) {
    set_threads(1);
    BondedSystem bonded(ElasticSystem(state.range(0), monaghan));
    const std::size_t n = bonded.model.particles().size();
    const double dt = 0.1, shear = 0.9 / std::sqrt(static_cast<double>(n));
    double* const x = bonded.y.data();
    double* const v = x + 2 * n;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t a = 0; a < 2; ++a)
            v[2 * i + a] = 0.1 * std::sin(1e4 * static_cast<double>(2 * i + a)) +
                           (a == 0 ? shear * x[2 * i + 1] : 0.0);
    const double* const v_dot = bonded.y_dot.data() + 2 * n;
    bonded.rates();
    double update = 0.0, own = 0.0;
    std::size_t updates = bonded.model.list_builds(), steps = 0;
    for ([[maybe_unused]] auto _ : state) {
        for (std::size_t c = 0; c < 2 * n; ++c) {
            v[c] += 0.5 * dt * v_dot[c];
            x[c] += dt * v[c];
        }
        const Stopwatch watch;
        bonded.rates();
        own += watch.seconds();
        for (std::size_t c = 0; c < 2 * n; ++c) v[c] += 0.5 * dt * v_dot[c];
        const Stopwatch settling;
        bonded.model.settle(0.0, bonded.y);
        update += settling.seconds();
        ++steps;
    }
    updates = bonded.model.list_builds() - updates;
    state.counters["in_rates"] = update / own;
    state.counters["steps_per_update"] =
        static_cast<double>(steps) / static_cast<double>(std::max<std::size_t>(1, updates));
}

}  // namespace

BENCHMARK(material_vectors_over_elastic)
    ->Arg(2000)
    ->Arg(5000)
    ->Arg(20000)
    ->Arg(200000)
    ->Iterations(40)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(material_vectors_at_work)
    ->Arg(2000)
    ->Arg(20000)
    ->Arg(200000)
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(material_vectors_update)
    ->ArgsProduct({{2000, 20000, 200000}, {0, 1}})
    ->Iterations(40)
    ->Unit(benchmark::kMillisecond);

}  // namespace spam::bench

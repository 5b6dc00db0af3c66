// SPDX-License-Identifier: GPL-3.0-or-later
// Particles that change neighbours: what their lists cost.
#include "stepping.hpp"
#include <spam/core/instruction_set.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/physics/record.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <random>

namespace spam::bench {
namespace {

/// Builds of a list of that skin and stride for the system as it is.
template <class System>
void time_builds(benchmark::State& state, System& system, double skin, std::size_t stride) {
    system.rates();
    const auto& model = system.model;
    const Points<2> x = ConstState<2>(model.layout(), system.y).position();
    ClusterList<2> list(model.reach(), skin, model.box(), native_lanes(instruction_set()), stride);
    list.build(x);
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) list.build(x);
    count(state, model, watch.seconds() / static_cast<double>(state.iterations()));
}

void list_build(benchmark::State& state) {
    ElasticSystem system(state.range(0), monaghan);
    time_builds(state, system, 0.225, Record<2>::numbers);
}
void lucy_list_build(benchmark::State& state) {
    GasSystem system(state.range(0), 0.0);
    time_builds(state, system, 0.75, PointRecord<2>::numbers);
}

/// A step of rk4 of the hot gas, per right-hand side.
void lucy_run(benchmark::State& state) {
    GasSystem system(state.range(0), 1.0);
    Stepping stepping(system, rk4(0.08));
    for (int k = 0; k < 20; ++k) stepping.step();
    stepping.forget();
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) stepping.step();
    const double seconds = watch.seconds(), calls = static_cast<double>(stepping.calls());
    count(state, system.model, seconds / calls);
    state.counters["list_builds_per_rhs"] = static_cast<double>(stepping.builds()) / calls;
}

/// n x n particles of Lucy's gas at rest, h = 6, in the middle of a periodic box twice as wide,
/// [HH01]: rk4, dt = 0.25, up to t = n, long after the gas has filled the box.
struct Expansion {
    PairPotentialModel<2> model;
    std::vector<double> y;

    explicit Expansion(int n)
        : model(make_particles<2>(square_lattice<2>({n, n}), 1.0, 1.0, box(n)), 6.0, box(n)) {
        y = initial_state<2>(model, 1.0, 1.0, [](const Point<2>&) { return Point<2>(0.0, 0.0); });
        std::mt19937_64 random(4);
        std::uniform_real_distribution<double> u(-0.05, 0.05);
        for (std::size_t k = 0; k < 2 * model.particles().size(); ++k) y[k] += u(random);
    }
    static Box<2> box(int n) { return Box<2>({2.0 * n, 2.0 * n}); }
};

/// share_of_rebuilds: of all the time of a whole expansion. Each list is built a second time, on the
/// same positions, for its time.
void free_expansion(benchmark::State& state) {
    const auto n = static_cast<int>(state.range(0));
    Expansion system(n);
    Stepping stepping(system, rk4(0.25));
    stepping.step();
    stepping.forget();
    ClusterList<2> list(6.0, 1.4, Expansion::box(n), native_lanes(instruction_set()));
    double seconds = 0.0, building = 0.0;
    for ([[maybe_unused]] auto _ : state) {
        for (int k = 0; k < 4 * n; ++k) {
            const std::size_t built = stepping.builds();
            const Stopwatch watch;
            stepping.step();
            seconds += watch.seconds();
            const auto again = static_cast<double>(stepping.builds() - built);
            if (again == 0.0) continue;
            const auto x = ConstState<2>(system.model.layout(), stepping.y()).position();
            const Stopwatch build;
            list.build(x);
            building += again * build.seconds();
        }
    }
    const double calls = static_cast<double>(stepping.calls());
    count(state, system.model, seconds / calls);
    state.counters["list_builds_per_rhs"] = static_cast<double>(stepping.builds()) / calls;
    state.counters["share_of_rebuilds"] = building / seconds;
}

}  // namespace

BENCHMARK(list_build)->Apply(sizes);
BENCHMARK(lucy_list_build)->Arg(20000)->Unit(benchmark::kMicrosecond);
BENCHMARK(lucy_run)->Arg(20000)->Arg(200000)->Unit(benchmark::kMicrosecond);
BENCHMARK(free_expansion)->Arg(64)->Arg(128)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace spam::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// Whole steps. share_outside_rhs: of the time. bytes_per_particle: by which the process has grown,
// all told (state, vectors of the integrator, particles, list, records).
#include "stepping.hpp"

#include <unistd.h>

#include <fstream>

namespace spam::bench {
namespace {

double resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    double size = 0.0, resident = 0.0;
    statm >> size >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void step(benchmark::State& state, const IntegratorOptions& options) {
    const double before = resident_bytes();
    ElasticSystem system(state.range(0), monaghan);
    Stepping stepping(system, options);
    stepping.step();
    stepping.forget();
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) stepping.step();
    const double seconds = watch.seconds(), steps = static_cast<double>(state.iterations());
    count(state, system.model, seconds / steps);
    state.counters["share_outside_rhs"] = (seconds - stepping.seconds_in_rates()) / seconds;
    state.counters["list_builds_per_step"] = static_cast<double>(stepping.builds()) / steps;
    state.counters["bytes_per_particle"] =
        (resident_bytes() - before) / static_cast<double>(system.model.particles().size());
}

void rk4_step(benchmark::State& state) { step(state, rk4(0.01)); }

void dormand_prince_step(benchmark::State& state) {
    IntegratorOptions options;
    options.method = "arkode:DORMAND_PRINCE_7_4_5";
    step(state, options);
}

}  // namespace

BENCHMARK(rk4_step)->Apply(sizes)->Arg(10000000);
BENCHMARK(dormand_prince_step)->Apply(sizes);

}  // namespace spam::bench

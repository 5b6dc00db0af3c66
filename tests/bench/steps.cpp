// SPDX-License-Identifier: GPL-3.0-or-later
// Whole steps. share_outside_rhs: of the time. bytes_per_particle: by which the process has grown,
// all told (state, vectors of the integrator, particles, list, records).
#include "stepping.hpp"
#include <spam/integrate/methods.hpp>

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

/// Every method, elastic solid: steps of 0.01, adaptive ones where a method takes no others.
const bool all_methods = [] {
    for (const IntegrationMethod& method : integration_methods()) {
        if (method.separable) continue;
        IntegratorOptions options;
        options.method = method.name;
        for (const bool fixed : {true, false}) {
            if (!(fixed ? method.fixed : method.adaptive)) continue;
            options.dt = fixed ? std::optional(0.01) : std::nullopt;
            const std::string name = "method_step:" + method.name + (fixed ? ",fixed" : "");
            benchmark::RegisterBenchmark(
                name.c_str(), [options](benchmark::State& state) { step(state, options); })
                ->Arg(2000)
                ->Arg(200000);
        }
    }
    return true;
}();

}  // namespace

BENCHMARK(rk4_step)->Apply(sizes)->Arg(10000000);
BENCHMARK(dormand_prince_step)->Apply(sizes);

}  // namespace spam::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// Right-hand sides.
#include "fma_peak.hpp"
#include "systems.hpp"
#include <spam/core/error.hpp>

#include <fmt/format.h>

namespace spam::bench {
namespace {

/// Additions and multiplications of one particle of a pair in the sweep of elastic_rhs, as the
/// formulas read; divisions and roots count one: separation 6, w and its gradient 10, v_ji 2,
/// volume 2, grad v 10, rho_dot 5, u 4, force 9, v_dot 4, power 5.
constexpr double flops_of_a_neighbour = 57.0;

void elastic_rhs(benchmark::State& state) {
    ElasticSystem system(state.range(0), monaghan);
    time_rates(state, system);
    const double neighbours = neighbours_in_range(system.model, system.y);
    state.counters["neighbours"] = neighbours;
    state.counters["share_of_fma_peak"] = flops_of_a_neighbour * neighbours /
                                          state.counters["ns_per_particle"].value /
                                          (1e-9 * fma_peak());
}
void elastic_rhs_two_sweeps(benchmark::State& state) {
    Scheme scheme = monaghan;
    scheme.density = Density::summed;
    ElasticSystem system(state.range(0), scheme);
    time_rates(state, system);
}
void elastic_rhs_shuffled(benchmark::State& state) {
    ElasticSystem system(state.range(0), monaghan, Given::shuffled);
    time_rates(state, system);
}
void lucy_rhs(benchmark::State& state) {
    GasSystem system(state.range(0), 0.0);
    time_rates(state, system);
    state.counters["neighbours"] = neighbours_in_range(system.model, system.y);
}

void rhs_of_scheme(benchmark::State& state, const Scheme& scheme) {
    ElasticSystem system(16000, scheme);
    time_rates(state, system);
}

/// rhs_of_scheme/<density>/<transport>/<mean density>/<angular momentum>
[[maybe_unused]] const int schemes = [] {
    for (const auto density : {Density::continuity, Density::summed, Density::chain_rule})
        for (const auto transport : {Transport::plain, Transport::average, Transport::monaghan})
            for (const auto mean : {MeanDensityKind::arithmetic, MeanDensityKind::geometric})
                for (const auto torque : {AngularMomentum::free, AngularMomentum::torque_pair}) {
                    const Scheme scheme{density, transport, mean, torque};
                    try {
                        scheme.validate(2);
                    } catch (const InputError&) {
                        continue;
                    }
                    benchmark::RegisterBenchmark(
                        fmt::format("rhs_of_scheme/{}/{}/{}/{}", to_string(density),
                                    to_string(transport), to_string(mean), to_string(torque))
                            .c_str(),
                        rhs_of_scheme, scheme)
                        ->Unit(benchmark::kMicrosecond);
                }
    return 0;
}();

}  // namespace

BENCHMARK(elastic_rhs)->Apply(sizes);
BENCHMARK(elastic_rhs_two_sweeps)->Apply(sizes);
BENCHMARK(elastic_rhs_shuffled)->Apply(sizes);
BENCHMARK(lucy_rhs)->Apply(sizes);

}  // namespace spam::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// Right-hand sides in the plane and in space in turn, and the lists that they need.
//   plane_and_space/<system>/<angular momentum>/N
#include "support/measured_systems.hpp"
#include "systems.hpp"
#include <spam/core/instruction_set.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/physics/record.hpp>

#include <cmath>

namespace spam::bench {
namespace {

/// Least times of what is done again and again.
template <int Dim>
struct Timed {
    test::MeasuredSystem<Dim> system;
    ClusterList<Dim> list{system.model->reach(),
                          0.075 * system.model->reach(),
                          {},
                          native_lanes(instruction_set()),
                          Record<Dim>::numbers};
    double rates = HUGE_VAL, build = HUGE_VAL;

    void once() {
        rates = least_seconds(rates, [&] { system.rates(); });
        const Points<Dim> x = system.position();
        build = least_seconds(build, [&] { list.build(x); });
    }
    /// Nanoseconds a particle and a pair of the list, pairs a particle, and what a list takes, in right-hand
    /// sides; in space sums over torques for each balance.
    void count(benchmark::State& state, const std::string& where) const {
        const auto particles = static_cast<double>(system.model->particles().size());
        const auto pairs = static_cast<double>(system.model->pairs());
        state.counters[where + "_particles"] = particles;
        state.counters[where + "_ns_per_particle"] = 1e9 * rates / particles;
        state.counters[where + "_ns_per_pair"] = 1e9 * rates / pairs;
        state.counters[where + "_pairs_per_particle"] = pairs / particles;
        state.counters[where + "_list_in_rates"] = build / rates;
        if (system.law == nullptr || system.law->torque_search().balances == 0) return;
        const TorqueSearch search = system.law->torque_search();
        state.counters[where + "_sums"] =
            static_cast<double>(search.sums) / static_cast<double>(search.balances);
    }
};

void plane_and_space(benchmark::State& state, const std::string& name, AngularMomentum law) {
    Timed<2> plane{{name, state.range(0), law}};
    Timed<3> space{{name, state.range(0), law}};
    for ([[maybe_unused]] auto _ : state) {
        plane.once();
        space.once();
    }
    plane.count(state, "plane");
    space.count(state, "space");
}

[[maybe_unused]] const bool all_systems = [] {
    for (const char* name : {"one_sweep", "two_sweeps", "fluid", "total_lagrangian"})
        for (const auto law : {AngularMomentum::free, AngularMomentum::torque_pair})
            if (name != std::string("total_lagrangian") || law == AngularMomentum::free)
                benchmark::RegisterBenchmark(
                    ("plane_and_space/" + std::string(name) + "/" + std::string(to_string(law)))
                        .c_str(),
                    plane_and_space, name, law)
                    ->Arg(20000)
                    ->Arg(200000)
                    ->Iterations(15)
                    ->Unit(benchmark::kMillisecond);
    return true;
}();

}  // namespace
}  // namespace spam::bench

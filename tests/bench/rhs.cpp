// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a right-hand side costs: hexagons of elastic solid, Lucy, h = 3 spacings, one thread.
//   elastic_rhs/N            <v>_Monaghan, continuity density: one sweep over the pairs
//   elastic_rhs_plain/N      plain velocity
//   elastic_rhs_torque/N     <v>_Monaghan with balanced pair torques: two sweeps
//   list_build/N             cell grid and pair list from scratch
//   rk4_step/N               a whole step, four right-hand sides and the N_Vector operations
//   dormand_prince_step/N    a step of the adaptive default
// Counters: ns_per_particle (per right-hand side; per build; per step), ns_per_pair and
// pairs_per_second (undirected pairs within the list), share_outside_rhs for the steps.
#include <spam/core/instruction_set.hpp>
#include <spam/core/parallel.hpp>
#include <spam/integrate/integrator.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/neighbors/cluster_list.hpp>
#include <spam/rhs/smooth_particle_model.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <benchmark/benchmark.h>

#include <chrono>
#include <random>

namespace {

using namespace spam;

const Scheme monaghan{.transport = Transport::monaghan};

struct System {
    SmoothParticleModel<2> model;
    std::vector<double> y, y_dot;

    /// A hexagon of at least n particles, jittered so that no pair sits exactly at the range.
    System(int n, const Scheme& scheme)
        : model(make_particles<2>(triangular_hexagon(radius(n)), 1.0),
                ElasticSolid::triangular_lattice(), scheme) {
        set_threads(1);
        y = initial_state<2>(model, std::sqrt(4.0 / 3.0), 0.433, rigid_rotation(1e-3));
        y_dot.resize(y.size());
        std::mt19937_64 random(1);
        std::uniform_real_distribution<double> u(-0.01, 0.01);
        for (double& x : y) x += u(random);
        model.rates(0.0, y, y_dot);
    }
    static int radius(int n) {
        int r = 1;
        while (1 + 3 * r * (r + 1) < n) ++r;
        return r;
    }
    double particles() const { return static_cast<double>(model.particles().size()); }
};

void count(benchmark::State& state, const System& system, double seconds) {
    const double per_call = seconds / static_cast<double>(state.iterations());
    const auto pairs = static_cast<double>(system.model.pairs());
    state.counters["particles"] = system.particles();
    state.counters["ns_per_particle"] = 1e9 * per_call / system.particles();
    state.counters["ns_per_pair"] = 1e9 * per_call / pairs;
    state.counters["pairs_per_second"] = pairs / per_call;
}

class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void right_hand_side(benchmark::State& state, const Scheme& scheme) {
    System system(static_cast<int>(state.range(0)), scheme);
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) system.model.rates(0.0, system.y, system.y_dot);
    count(state, system, watch.seconds());
}

void elastic_rhs(benchmark::State& state) { right_hand_side(state, monaghan); }
void elastic_rhs_plain(benchmark::State& state) { right_hand_side(state, {}); }
void elastic_rhs_torque(benchmark::State& state) {
    Scheme scheme = monaghan;
    scheme.angular_momentum = AngularMomentum::torque_pair;
    right_hand_side(state, scheme);
}

void list_build(benchmark::State& state) {
    System system(static_cast<int>(state.range(0)), monaghan);
    const Points<2> x = State<2>(system.model.layout(), system.y).position();
    ClusterList<2> list(3.0, 0.3, {}, native_lanes(instruction_set()));
    list.build(x);
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) list.build(x);
    count(state, system, watch.seconds());
}

void step(benchmark::State& state, IntegratorOptions options) {
    System system(static_cast<int>(state.range(0)), monaghan);
    const SundialsContext context;
    Vector y(system.y.size(), context);
    std::copy(system.y.begin(), system.y.end(), y.span().begin());
    double in_rates = 0.0;
    Ode ode;
    ode.rates = [&](double t, std::span<const double> z, std::span<double> z_dot) {
        const Stopwatch watch;
        system.model.rates(t, z, z_dot);
        in_rates += watch.seconds();
    };
    ode.failure = [] { return std::string{}; };
    ode.entry_name = [](std::size_t) { return std::string{}; };
    ode.absolute_tolerance.assign(system.y.size(), 1e-10);
    const auto integrator = make_integrator(options, ode, y, 0.0, context);
    integrator->step(1e9);
    in_rates = 0.0;
    const Stopwatch watch;
    for ([[maybe_unused]] auto _ : state) integrator->step(1e9);
    const double seconds = watch.seconds();
    count(state, system, seconds);
    state.counters["share_outside_rhs"] = (seconds - in_rates) / seconds;
    state.counters["list_builds_per_step"] =
        static_cast<double>(system.model.list_builds()) / static_cast<double>(state.iterations());
}

void rk4_step(benchmark::State& state) {
    IntegratorOptions options;
    options.dt = 0.01;
    step(state, options);
}

void dormand_prince_step(benchmark::State& state) {
    IntegratorOptions options;
    options.method = "arkode:DORMAND_PRINCE_7_4_5";
    step(state, options);
}

void sizes(benchmark::internal::Benchmark* b) {
    b->Arg(217)->Arg(2000)->Arg(16000)->Arg(20000)->Arg(64000)->Arg(200000)->Arg(1000000)->Unit(
        benchmark::kMicrosecond);
}

}  // namespace

BENCHMARK(elastic_rhs)->Apply(sizes);
BENCHMARK(elastic_rhs_plain)->Apply(sizes);
BENCHMARK(elastic_rhs_torque)->Apply(sizes);
BENCHMARK(list_build)->Apply(sizes);
BENCHMARK(rk4_step)->Apply(sizes);
BENCHMARK(dormand_prince_step)->Apply(sizes);

BENCHMARK_MAIN();

// SPDX-License-Identifier: GPL-3.0-or-later
#include "systems.hpp"

#include "support/measured_systems.hpp"
#include <spam/neighbors/pair_list.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace spam::bench {
namespace {

Points<2> hexagon(std::int64_t n, Given given) {
    Points<2> x = test::round_body<2>(n);
    if (given == Given::shuffled) {
        std::mt19937_64 random(2);
        for (Eigen::Index k = x.cols() - 1; k > 0; --k)
            x.col(k).swap(x.col(std::uniform_int_distribution<Eigen::Index>(0, k)(random)));
    }
    return x;
}

struct Block {
    int columns, rows;  ///< even, so that the lattice repeats
    explicit Block(std::int64_t n) {
        const double scale = std::sqrt(static_cast<double>(n) / 20000.0);
        columns = std::max(8, static_cast<int>(std::lround(66.0 * scale))) * 2;
        rows = std::max(8, static_cast<int>(std::lround(76.0 * scale))) * 2;
    }
    Box<2> box() const { return Box<2>({static_cast<double>(columns), rows * std::sqrt(0.75)}); }
};

}  // namespace

ElasticSystem::ElasticSystem(std::int64_t n, const Scheme& scheme, Given given)
    : model(make_particles<2>(hexagon(n, given), 1.0), ElasticSolid::triangular_lattice(), scheme) {
    y = initial_state<2>(model, std::sqrt(4.0 / 3.0), 0.433, rigid_rotation(1e-3));
    y_dot.resize(y.size());
    test::jitter(y);
}

GasSystem::GasSystem(std::int64_t n, double speed)
    : model(make_particles<2>(triangular_block(Block(n).columns, Block(n).rows), 1.0, 1.0,
                              Block(n).box()),
            6.0, Block(n).box()) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> component(0.0, speed);
    y = initial_state<2>(model, 1.0, 1.0, [&](const Point<2>&) {
        return speed > 0.0 ? Point<2>(component(random), component(random)) : Point<2>(0.0, 0.0);
    });
    y_dot.resize(y.size());
    test::jitter({y.data(), 2 * model.particles().size()});
}

double neighbours_in_range(const Model<2>& model, std::span<const double> y) {
    const PairList<2> list(ConstState<2>(model.layout(), y).position(), model.reach(), model.box());
    std::size_t directed = 0;
    for (std::size_t i = 0; i < list.size(); ++i) directed += list.neighbours(i).size() - 1;
    return static_cast<double>(directed) / static_cast<double>(list.size());
}

void count(benchmark::State& state, const Model<2>& model, double seconds_per_call) {
    const auto particles = static_cast<double>(model.particles().size());
    const auto pairs = static_cast<double>(model.pairs());
    state.counters["particles"] = particles;
    state.counters["ns_per_particle"] = 1e9 * seconds_per_call / particles;
    state.counters["ns_per_pair"] = 1e9 * seconds_per_call / pairs;
    state.counters["pairs_per_second"] = pairs / seconds_per_call;
}

void sizes(benchmark::internal::Benchmark* b) {
    b->Arg(217)->Arg(2000)->Arg(16000)->Arg(20000)->Arg(64000)->Arg(200000)->Arg(1000000)->Unit(
        benchmark::kMicrosecond);
}

}  // namespace spam::bench

// SPDX-License-Identifier: GPL-3.0-or-later
// What yield costs: right-hand sides of a solid of which about half yields, in turn with those of the elastic one.
#include "systems.hpp"
#include <spam/core/parallel.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/spam.hpp>

#include <cmath>
#include <vector>

namespace spam::bench {
namespace {

/// A lattice with stresses of +-0.002 where the yield stress is 0.001.
template <int Dim, class Material>
struct Solid {
    SmoothParticleModel<Dim> model;
    std::vector<double> y, rates;

    Solid(const Points<Dim>& x, const Material& material)
        : model(make_particles<Dim>(x, 1.0), material, Scheme{}) {
        y = initial_state<Dim>(model, 1.0, 0.43, [](const Point<Dim>& r) {
            Point<Dim> v = Point<Dim>::Zero();
            v[0] = 0.1 * std::sin(0.05 * r[0]);
            v[1] = 0.1 * std::cos(0.07 * r[1]);
            return v;
        });
        State<Dim> state(model.layout(), y);
        double k = 0.0;
        for (double& s : state.stress().reshaped()) s = 0.002 * std::sin(8e4 * k++);
        rates.resize(y.size());
    }
    void once() { model.rates(0.1, y, rates); }
};

template <int Dim, class Surface>
void yield_over_elastic(benchmark::State& state) {
    set_threads(1);
    const double e = 0.43;
    Points<Dim> x;
    if constexpr (Dim == 2)
        x = square_lattice<2>({142, 142});
    else
        x = square_lattice<3>({27, 27, 27});
    Solid<Dim, ElasticSolid> elastic(x, ElasticSolid{e, e});
    Solid<Dim, YieldingSolid<Surface>> plastic(
        x, YieldingSolid<Surface>({e, e}, LinearHardening{1e-3, 0.1}));
    double without = HUGE_VAL, with = HUGE_VAL;
    for ([[maybe_unused]] auto _ : state) {
        without = least_seconds(without, [&] { elastic.once(); });
        with = least_seconds(with, [&] { plastic.once(); });
    }
    state.counters["over_elastic"] = with / without;
}

}  // namespace

BENCHMARK(yield_over_elastic<2, PlaneVonMises>)->Iterations(60)->Unit(benchmark::kMillisecond);
BENCHMARK(yield_over_elastic<2, PlaneStrainVonMises>)
    ->Iterations(60)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(yield_over_elastic<2, PlaneStressVonMises>)
    ->Iterations(60)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(yield_over_elastic<3, SpaceVonMises>)->Iterations(60)->Unit(benchmark::kMillisecond);

}  // namespace spam::bench

// SPDX-License-Identifier: GPL-3.0-or-later
#include "density_potential_sweeps.hpp"

#include "sweep_clusters.hpp"
#include <spam/physics/curvature_strength.hpp>
#include <spam/physics/density_passes.hpp>
#include <spam/physics/embedded_energy.hpp>
#include <spam/physics/surface_tension.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
using T = LanesOf<W>;

/// Nearest images are looked for everywhere: in open space the box subtracts zeros, which these long
/// bodies do not feel, and half as much is to be compiled.
template <int Dim, class R, class Pass, class Store>
[[gnu::flatten, gnu::noinline]] void sweep_some(const SweepInput<Dim>& in, std::size_t begin,
                                                std::size_t end, const GeneralWeight<Dim>& weight,
                                                const std::tuple<Pass>& pass,
                                                const Store& store_sums) {
    sweep_block<W, Dim, R, Pass>(in.list, begin, end, weight, *in.box, in.records, store_sums,
                                 pass);
}

template <int Dim, class R, class Pass, class Store>
void sweep_all(const SweepInput<Dim>& in, const GeneralWeight<Dim>& weight, const Pass& pass,
               const Store& store_sums) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_some<Dim, R, Pass>(in, begin, end, weight, {pass}, store_sums);
    });
}

template <int Dim, class... Terms>
void fields(const SweepInput<Dim>& in, const DensityPotentialOutput<Dim>& out) {
    using Record = SlopeRecord<Dim, double, Terms...>;
    using Pass = DensityFields<Dim, Terms...>;
    sweep_all<Dim, PointRecord<Dim>>(
        in, out.weight, Pass{out.weight}, [&](std::size_t slot, const auto&, const auto& sums) {
            for_each_lane<W>(in.list, slot, [&](int l, std::size_t) {
                double* to =
                    out.records + (slot + std::size_t(l)) * in.records.stride + Record::slopes_at;
                const auto write = [&](const T& number) { *to++ = lane(number, l); };
                std::apply([&](const auto&... f) { (for_each_number(f, write), ...); },
                           sums.fields);
            });
        });
}

template <int Dim, class... Terms>
void forces(const SweepInput<Dim>& in, const DensityPotentialOutput<Dim>& out) {
    using Record = SlopeRecord<Dim, double, Terms...>;
    using Pass = DensityForces<Dim, Terms...>;
    sweep_all<Dim, Record>(
        in, out.weight, Pass{out.weight, out.core},
        [&](std::size_t slot, const auto& i, const auto& sums) {
            const Vec<Dim, T> v_dot = sums.v_dot + (T(1.0) / i.m) * sums.core_force;
            for_each_lane<W>(in.list, slot,
                             [&](int l, std::size_t n) { store<Dim>(out.v_dot, n, l, v_dot); });
        });
}

/// Without what a particle would have of itself.
template <int Dim>
void energy(const SweepInput<Dim>& in, const DensityPotentialOutput<Dim>& out) {
    sweep_all<Dim, PointRecord<Dim>>(in, out.weight, CoreEnergy<Dim>{out.core},
                                     [&](std::size_t slot, const auto&, const auto& sums) {
                                         for_each_lane<W>(in.list, slot, [&](int l, std::size_t n) {
                                             out.energy[n] =
                                                 0.5 * (lane(sums.energy, l) - out.core.e_c);
                                         });
                                     });
}

template <int Dim, class... Terms>
DensityPotentialSweeps<Dim> sweeps_of_terms() {
    return {W, fields<Dim, Terms...>, forces<Dim, Terms...>, energy<Dim>};
}

}  // namespace

template <int Dim, InstructionSet Level>
DensityPotentialSweeps<Dim> density_potential_sweeps(bool shape) {
    if (!shape) return sweeps_of_terms<Dim, DensityItself>();
    if constexpr (Dim == 1)
        return sweeps_of_terms<Dim, DensityItself, SurfaceTension>();
    else
        return sweeps_of_terms<Dim, DensityItself, SurfaceTension, CurvatureStrength>();
}

template DensityPotentialSweeps<1> density_potential_sweeps<1, InstructionSet::SPAM_LEVEL>(bool);
template DensityPotentialSweeps<2> density_potential_sweeps<2, InstructionSet::SPAM_LEVEL>(bool);
template DensityPotentialSweeps<3> density_potential_sweeps<3, InstructionSet::SPAM_LEVEL>(bool);

}  // namespace spam

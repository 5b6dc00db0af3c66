// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_clusters.hpp"
#include <spam/physics/pair_potential.hpp>
#include <spam/physics/record.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);

/// Writes PointRecords.
template <int Dim, bool Wraps>
std::size_t pack_points(const PackInput<Dim>& whole, double* records) {
    const PackInput<Dim> in = whole;  // a copy that the stores below cannot be suspected to change
    const Box<Dim> box = *whole.box;
    return parallel_count(in.slots, [=](std::size_t slot) {
        const std::size_t i = in.order[slot];
        double* const record = records + slot * in.stride;
        double x[Dim];
        for (std::size_t a = 0; a < Dim; ++a) x[a] = in.x[Dim * i + a];
        const std::size_t far = in.displacement.too_far(i, x);
        for (int a = 0; a < Dim; ++a)
            record[a] = Wraps && box.periodic(a) ? box.wrap(a, x[a]) : x[a];
        record[Dim] = in.m[i];
        return far;
    });
}
template <int Dim>
PackCount pack(const PackInput<Dim>& in, bool, double* records) {
    return {in.box->periodic() ? pack_points<Dim, true>(in, records)
                               : pack_points<Dim, false>(in, records),
            0};
}

template <int Dim>
void force(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<LucysSweep, W, Dim, PointRecord<Dim>, PairPotential<Dim>>(
            in, begin, end, [&](std::size_t slot, const auto&, const auto& sums) {
                for_each_lane<W>(in.list, slot, [&](int l, std::size_t i) {
                    store<Dim>(out.v_dot, i, l, sums.v_dot);
                });
            });
    });
}

}  // namespace

template <int Dim, InstructionSet Level>
Sweeps<Dim> potential_sweeps() {
    Sweeps<Dim> sweeps{W};
    sweeps.pack = pack<Dim>;
    sweeps.density = density_sweep<LucysSweep, W, Dim, PointRecord<Dim>>;
    sweeps.first = force<Dim>;
    return sweeps;
}

template Sweeps<1> potential_sweeps<1, InstructionSet::SPAM_LEVEL>();
template Sweeps<2> potential_sweeps<2, InstructionSet::SPAM_LEVEL>();
template Sweeps<3> potential_sweeps<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

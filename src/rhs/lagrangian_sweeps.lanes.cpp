// SPDX-License-Identifier: GPL-3.0-or-later
#include "lagrangian_sweeps.hpp"

#include "sweep_clusters.hpp"
#include <spam/physics/deformation_gradient.hpp>
#include <spam/physics/reference_force.hpp>
#include <spam/physics/zero_energy_penalty.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
using T = LanesOf<W>;

/// Where the numbers of a slot's record begin that lie `at` places behind its first.
template <int Dim>
double* place(const SweepInput<Dim>& in, const LagrangianOutput<Dim>& out, std::size_t slot,
              int at) {
    return out.records + slot * in.records.stride + at;
}

/// Into the records of the cluster that begins at `slot`.
template <int Dim>
SPAM_INLINE void write(const SweepInput<Dim>& in, const LagrangianOutput<Dim>& out,
                       std::size_t slot, int at, const Mat<Dim, T>& value) {
    for_each_lane<W>(in.list, slot, [&](int l, std::size_t) {
        double* const to = place(in, out, slot + static_cast<std::size_t>(l), at);
        for (std::size_t k = 0; k < Dim * Dim; ++k) to[k] = lane(value.c[k], l);
    });
}

template <int Dim>
SPAM_INLINE Mat<Dim, T> read(const SweepInput<Dim>& in, const LagrangianOutput<Dim>& out,
                             std::size_t slot, int at) {
    Mat<Dim, T> value;
    for_each_lane<W>(in.list, slot, [&](int l, std::size_t) {
        const double* const from = place(in, out, slot + static_cast<std::size_t>(l), at);
        for (std::size_t k = 0; k < Dim * Dim; ++k) set_lane(value.c[k], l, from[k]);
    });
    return value;
}

template <int Dim>
void gradient(const SweepInput<Dim>& in, const LagrangianOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<LucysSweep, W, Dim, ReferenceRecord<Dim>, DeformationGradient<Dim>>(
            in, begin, end, [&](std::size_t slot, const auto& i, const auto& sums) {
                write<Dim>(in, out, slot, DeformedRecord<Dim>::F_at, sums.A * i.K);
            });
        if (out.stresses != nullptr)
            out.stresses(out.context, begin * W, std::min(end * W, in.list.particles) - begin * W);
    });
}

template <int Dim>
void penalty(const SweepInput<Dim>& in, const LagrangianOutput<Dim>& out) {
    const T v_dot_factor = out.penalty * out.inverse_density, M_factor = -out.penalty;
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<LucysSweep, W, Dim, DeformedRecord<Dim>, ZeroEnergyPenalty<Dim>>(
            in, begin, end, [&](std::size_t slot, const auto& i, const auto& sums) {
                constexpr int at = StressedRecord<Dim>::B_at;
                const Mat<Dim, T> P = read<Dim>(in, out, slot, at) + M_factor * sums.M;
                write<Dim>(in, out, slot, at, P * i.K);
                const Vec<Dim, T> v_dot = v_dot_factor * sums.force;
                for_each_lane<W>(in.list, slot,
                                 [&](int l, std::size_t n) { store<Dim>(out.v_dot, n, l, v_dot); });
            });
    });
}

template <int Dim>
void force(const SweepInput<Dim>& in, const LagrangianOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<LucysSweep, W, Dim, StressedRecord<Dim>, ReferenceForce<Dim>>(
            in, begin, end, [&](std::size_t slot, const auto&, const auto& sums) {
                const Vec<Dim, T> v_dot = T(out.inverse_density) * sums.force;
                for_each_lane<W>(in.list, slot, [&](int l, std::size_t n) {
                    for (int a = 0; a < Dim; ++a)
                        out.v_dot[n * Dim + static_cast<std::size_t>(a)] += lane(v_dot[a], l);
                });
            });
    });
}

template <int Dim>
void energy(const SweepInput<Dim>& in, const LagrangianOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<LucysSweep, W, Dim, DeformedRecord<Dim>, PenaltyEnergy<Dim>>(
            in, begin, end, [&](std::size_t slot, const auto& i, const auto& sums) {
                const T value = T(out.penalty) * i.volume * sums.energy;
                for_each_lane<W>(in.list, slot,
                                 [&](int l, std::size_t n) { out.energy[n] = lane(value, l); });
            });
    });
}

}  // namespace

template <int Dim, InstructionSet Level>
LagrangianSweeps<Dim> lagrangian_sweeps() {
    return {W, gradient<Dim>, penalty<Dim>, force<Dim>, energy<Dim>};
}

template LagrangianSweeps<1> lagrangian_sweeps<1, InstructionSet::SPAM_LEVEL>();
template LagrangianSweeps<2> lagrangian_sweeps<2, InstructionSet::SPAM_LEVEL>();
template LagrangianSweeps<3> lagrangian_sweeps<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

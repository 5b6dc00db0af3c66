// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_sweeps.hpp"

#include "sweep_clusters.hpp"
#include <spam/physics/continuity.hpp>
#include <spam/physics/density_sum.hpp>
#include <spam/physics/fluid_record.hpp>
#include <spam/physics/heat_flow.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/pressure_force.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/velocity_gradient.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
using T = LanesOf<W>;

template <int Dim>
void density(const SweepInput<Dim>& in, const FluidOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<GeneralSweep, W, Dim, InviscidRecord<Dim>, DensitySum>(
            in, begin, end, [&](std::size_t slot, const auto&, const auto& sums) {
                for_each_lane<W>(in.list, slot,
                                 [&](int l, std::size_t i) { out.rho[i] = lane(sums.rho, l); });
            });
    });
}

template <int Dim>
void gradient(const SweepInput<Dim>& in, const FluidOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        Mat<Dim> grad_v[clusters_per_block * W];
        Vec<Dim> grad_T[clusters_per_block * W];
        sweep_clusters<GeneralSweep, W, Dim, GradientRecord<Dim>, VelocityGradient<Dim, EitherMean>,
                       TemperatureGradient<Dim, EitherMean>>(
            in, begin, end,
            [&](std::size_t slot, const auto&, const auto& velocity, const auto& temperature) {
                const Mat<Dim, T> of_v = velocity.value();
                const Vec<Dim, T> of_T = temperature.value();
                for (int l = 0; l < W; ++l) {
                    const std::size_t k = slot - begin * W + static_cast<std::size_t>(l);
                    for (std::size_t c = 0; c < Dim * Dim; ++c) grad_v[k].c[c] = lane(of_v.c[c], l);
                    for (int a = 0; a < Dim; ++a) grad_T[k][a] = lane(of_T[a], l);
                }
            });
        const std::size_t particles = std::min(end * W, in.list.particles) - begin * W;
        out.gradients(out.context, begin * W, in.list.order + begin * W, particles, grad_v, grad_T);
    });
}

/// Rates of the cluster that begins at `slot`.
template <int Dim>
SPAM_INLINE void store_rates(const SweepInput<Dim>& in, const FluidOutput<Dim>& out,
                             std::size_t slot, const Vec<Dim, T>& v_dot, const T& rho_dot,
                             const T& e_dot) {
    for_each_lane<W>(in.list, slot, [&](int l, std::size_t i) {
        for (int a = 0; a < Dim; ++a)
            out.v_dot[i * Dim + static_cast<std::size_t>(a)] = lane(v_dot[a], l);
        if (out.rho_dot != nullptr) out.rho_dot[i] = lane(rho_dot, l);
        out.e_dot[i] = lane(e_dot, l);
    });
}

template <int Dim>
void inviscid_force(const SweepInput<Dim>& in, const FluidOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<GeneralSweep, W, Dim, InviscidRecord<Dim>, PressureForce<Dim>, Continuity>(
            in, begin, end,
            [&](std::size_t slot, const auto&, const auto& force, const auto& continuity) {
                store_rates(in, out, slot, force.v_dot, continuity.rho_dot, force.e_dot());
            });
    });
}

template <int Dim>
void conducting_force(const SweepInput<Dim>& in, const FluidOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<GeneralSweep, W, Dim, ConductingRecord<Dim>, StressForce<Dim>, HeatFlow<Dim>,
                       Continuity>(in, begin, end,
                                   [&](std::size_t slot, const auto&, const auto& force,
                                       const auto& heat, const auto& continuity) {
                                       store_rates(in, out, slot, force.v_dot, continuity.rho_dot,
                                                   T(force.e_dot() + heat.e_dot));
                                   });
    });
}

}  // namespace

template <int Dim, InstructionSet Level>
FluidSweeps<Dim> fluid_sweeps(bool conducting) {
    FluidSweeps<Dim> sweeps{W};
    sweeps.density = density<Dim>;
    sweeps.force = conducting ? conducting_force<Dim> : inviscid_force<Dim>;
    if (conducting) sweeps.gradient = gradient<Dim>;
    return sweeps;
}

template FluidSweeps<1> fluid_sweeps<1, InstructionSet::SPAM_LEVEL>(bool);
template FluidSweeps<2> fluid_sweeps<2, InstructionSet::SPAM_LEVEL>(bool);
template FluidSweeps<3> fluid_sweeps<3, InstructionSet::SPAM_LEVEL>(bool);

}  // namespace spam

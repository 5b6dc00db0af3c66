// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep_clusters.hpp"
#include <spam/physics/continuity.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/physics/transport.hpp>
#include <spam/physics/velocity_gradient.hpp>
#include <spam/physics/viscosity.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
using T = LanesOf<W>;

template <int Dim, class Mean, class Transport, class Force>
void first(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        // By slot, and gone after the block: stress rates are found from it right away. Bytes, because
        // there is no need for zeros.
        alignas(64) std::byte memory[clusters_per_block * W * sizeof(Mat<Dim>)];
        auto* const grad_v = reinterpret_cast<Mat<Dim>*>(memory);
        sweep_clusters<W, Dim, Record<Dim>, VelocityGradient<Dim, Mean>, Continuity, Transport,
                       Force>(
            in, begin, end,
            [&](std::size_t slot, const auto& particles, const auto& gradient,
                const auto& continuity, const auto& transport, const auto& force) {
                const Vec<Dim, T> u = Transport::velocity(particles, transport);
                const Mat<Dim, T> gradient_v = gradient.value();
                for (std::size_t k = 0; k < Dim * Dim; ++k)
                    for (int l = 0; l < W; ++l)
                        grad_v[slot - begin * W + static_cast<std::size_t>(l)].c[k] =
                            lane(gradient_v.c[k], l);
                for_each_lane<W>(in.list, slot, [&](int l, std::size_t i) {
                    store<Dim>(out.x_dot, i, l, u);
                    if (out.rho_dot != nullptr) out.rho_dot[i] = lane(continuity.rho_dot, l);
                    if constexpr (std::is_same_v<Force, TorqueSums>) {
                        out.positive_torque[i] = lane(force.positive, l);
                        out.negative_torque[i] = lane(force.negative, l);
                    } else {
                        store<Dim>(out.v_dot, i, l, force.v_dot);
                        out.e_dot[i] = lane(force.e_dot(), l);
                    }
                });
            });
        const std::size_t particles = std::min(end * W, in.list.particles) - begin * W;
        out.stress_rates(out.context, in.list.order + begin * W, particles, grad_v);
    });
}

/// What needs the first sweep's results, or is wanted too seldom to be part of it: its variants are
/// many. Forces are added to those that the first sweep found; balanced ones take their place.
template <int Dim, class... Passes>
void second(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    constexpr bool in_place = (std::is_same_v<Passes, BalancedStressForce> || ...);
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<W, Dim, TransportRecord<Dim>, Passes...>(
            in, begin, end, [&](std::size_t slot, const auto&, const auto&... sums) {
                ForceSums<Dim, T> forces;
                bool found = false;
                const auto take = [&](const auto& s) {
                    if constexpr (requires { s.v_dot; }) {
                        forces.v_dot += s.v_dot;
                        forces.power += s.power;
                        found = true;
                    }
                };
                (take(sums), ...);
                for_each_lane<W>(in.list, slot, [&](int l, std::size_t i) {
                    const auto store_density = [&](const auto& s) {
                        if constexpr (requires { s.rho_dot; }) out.rho_dot[i] = lane(s.rho_dot, l);
                    };
                    (store_density(sums), ...);
                    if (!found) return;
                    for (int a = 0; a < Dim; ++a) {
                        double& v_dot = out.v_dot[i * Dim + static_cast<std::size_t>(a)];
                        v_dot = lane(forces.v_dot[a], l) + (in_place ? 0.0 : v_dot);
                    }
                    out.e_dot[i] = lane(forces.e_dot(), l) + (in_place ? 0.0 : out.e_dot[i]);
                });
            });
    });
}

/// Run-time choices of the scheme turned into the sweeps compiled for them.
template <int Dim>
struct Choices {
    static bool balances(const Scheme& scheme) {
        return scheme.angular_momentum == AngularMomentum::torque_pair ||
               scheme.angular_momentum == AngularMomentum::torque_particle;
    }
    template <class Mean, class Transport>
    static Sweep<Dim> first_of(const Scheme& scheme) {
        if constexpr (Dim == 2)
            if (balances(scheme)) return first<Dim, Mean, Transport, TorqueSums>;
        return first<Dim, Mean, Transport, StressForce<Dim>>;
    }
    template <class Mean>
    static Sweep<Dim> first_of(const Scheme& scheme) {
        switch (scheme.transport) {
            case Transport::plain:
                return first_of<Mean, PlainTransport<Dim>>(scheme);
            case Transport::average:
                return first_of<Mean, AverageTransport<Dim>>(scheme);
            case Transport::monaghan:
                break;
        }
        return first_of<Mean, MonaghanTransport<Dim, Mean>>(scheme);
    }
    template <class... Passes>
    static Sweep<Dim> with_density(const Scheme& scheme) {
        if (scheme.density == Density::chain_rule)
            return second<Dim, ChainRuleContinuity, Passes...>;
        if constexpr (sizeof...(Passes) > 0) return second<Dim, Passes...>;
        return nullptr;
    }
    template <class Mean>
    static Sweep<Dim> second_of(const Scheme& scheme) {
        const bool viscous = scheme.viscosity > 0.0;
        if constexpr (Dim == 2)
            if (balances(scheme))
                return viscous ? with_density<BalancedStressForce, ViscousForce<Dim, Mean>>(scheme)
                               : with_density<BalancedStressForce>(scheme);
        return viscous ? with_density<ViscousForce<Dim, Mean>>(scheme) : with_density<>(scheme);
    }
    template <class Mean>
    static void choose(const Scheme& scheme, Sweeps<Dim>& sweeps) {
        sweeps.first = first_of<Mean>(scheme);
        sweeps.second = second_of<Mean>(scheme);
    }
};

}  // namespace

template <int Dim, InstructionSet Level>
Sweeps<Dim> sweeps_of(const Scheme& scheme) {
    Sweeps<Dim> sweeps{W};
    if (scheme.mean_density == MeanDensityKind::arithmetic)
        Choices<Dim>::template choose<ArithmeticMean>(scheme, sweeps);
    else
        Choices<Dim>::template choose<GeometricMean>(scheme, sweeps);
    if (scheme.density == Density::summed) sweeps.density = density_sweep<W, Dim, Record<Dim>>;
    return sweeps;
}

template Sweeps<1> sweeps_of<1, InstructionSet::SPAM_LEVEL>(const Scheme&);
template Sweeps<2> sweeps_of<2, InstructionSet::SPAM_LEVEL>(const Scheme&);
template Sweeps<3> sweeps_of<3, InstructionSet::SPAM_LEVEL>(const Scheme&);

}  // namespace spam

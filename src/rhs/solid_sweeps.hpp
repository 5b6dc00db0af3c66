// SPDX-License-Identifier: GPL-3.0-or-later
// For *.lanes.cpp of this room: the sweeps of SmoothParticleModel.
#pragma once

#include "sweep_clusters.hpp"
#include <spam/physics/continuity.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/physics/transport.hpp>
#include <spam/physics/velocity_gradient.hpp>
#include <spam/physics/viscosity.hpp>

namespace spam {
inline namespace SPAM_LANES {

/// What needs only the state, and the stress rates.
template <class Kind, int W, int Dim, class Mean, class Transport, class Force>
void first_sweep(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    using T = LanesOf<W>;
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        // By slot, and gone after the block: stress rates are found from it right away. Bytes, because
        // there is no need for zeros.
        alignas(64) std::byte memory[clusters_per_block * W * sizeof(Mat<Dim>)];
        auto* const grad_v = reinterpret_cast<Mat<Dim>*>(memory);
        sweep_clusters<Kind, W, Dim, Record<Dim>, VelocityGradient<Dim, Mean>, Continuity,
                       Transport, Force>(
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
template <class Kind, int W, int Dim, class... Passes>
void second_sweep(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    using T = LanesOf<W>;
    constexpr bool in_place = (std::is_same_v<Passes, BalancedStressForce> || ...);
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<Kind, W, Dim, TransportRecord<Dim>, Passes...>(
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
                        if constexpr (requires { s.rho_dot; })
                            if (out.rho_dot != nullptr) out.rho_dot[i] = lane(s.rho_dot, l);
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

/// Whether torques are balanced, by a second sweep.
inline bool balances(const Scheme& scheme) {
    return scheme.angular_momentum == AngularMomentum::torque_pair ||
           scheme.angular_momentum == AngularMomentum::torque_particle;
}

/// The scheme's first sweep.
template <class Kind, int W, int Dim, class Mean>
struct FirstSweeps {
    static Sweep<Dim> of(const Scheme& scheme) {
        switch (scheme.transport) {
            case Transport::plain:
                return with<PlainTransport<Dim>>(scheme);
            case Transport::average:
                return with<AverageTransport<Dim>>(scheme);
            case Transport::monaghan:
                break;
        }
        return with<MonaghanTransport<Dim, Mean>>(scheme);
    }

  private:
    template <class Transport>
    static Sweep<Dim> with(const Scheme& scheme) {
        if constexpr (Dim == 2)
            if (balances(scheme)) return first_sweep<Kind, W, Dim, Mean, Transport, TorqueSums>;
        return first_sweep<Kind, W, Dim, Mean, Transport, StressForce<Dim>>;
    }
};

}  // namespace SPAM_LANES
}  // namespace spam

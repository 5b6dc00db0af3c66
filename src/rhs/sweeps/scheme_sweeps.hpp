// SPDX-License-Identifier: GPL-3.0-or-later
// For *.lanes.cpp: which passes a scheme of smooth particles needs.
#pragma once

#include "term_sweeps.hpp"
#include <spam/physics/continuity.hpp>
#include <spam/physics/density_sum.hpp>
#include <spam/physics/fluid_record.hpp>
#include <spam/physics/heat_flow.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/pair_friction.hpp>
#include <spam/physics/pressure_force.hpp>
#include <spam/physics/shifting.hpp>
#include <spam/physics/torque_balance_in_space.hpp>
#include <spam/physics/transport.hpp>
#include <spam/physics/velocity_gradient.hpp>
#include <spam/physics/viscosity.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {
inline namespace SPAM_LANES {

inline constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);

/// The sweep that finds, with the transport velocity, the forces or, where torques are balanced, the
/// torques; and what goes with them. A solid's velocity gradient is found on the way.
template <class Kind, int Dim, class Mean>
struct ForceSweeps {
    /// `torques`: those of the first sweep in space, where they are balanced; in the plane the scheme says it.
    template <bool torques = false>
    static Sweep<Dim> solid(const Scheme& scheme) {
        return by_transport<Work::mean, torques>(scheme, [](auto transport, auto force) {
            return run_sweep<Kind, W, Dim, Record<Dim>, VelocityGradient<Dim, Mean>, Continuity,
                             decltype(transport), decltype(force)>;
        });
    }
    /// Torques of one group of particles are balanced without a second sweep.
    static Sweep<Dim> one_balance(const Scheme& scheme) requires(Dim == 2) {
        return by_transport(scheme, [](auto transport, auto) {
            return run_sweep<Kind, W, Dim, Record<Dim>, VelocityGradient<Dim, Mean>, Continuity,
                             decltype(transport), TorqueParts>;
        });
    }
    template <Work work = Work::mean, bool torques = false>
    static Sweep<Dim> conducting(const Scheme& scheme) {
        if constexpr (work == Work::mean)
            if (scheme.transport == Transport::shifting)
                return run_sweep<Kind, W, Dim, ConductingRecord<Dim>, StressForce<Dim>,
                                 HeatFlow<Dim>, Continuity, ShiftingTransport<Dim, Mean>>;
        return by_transport<work, torques>(scheme, [](auto transport, auto force) {
            return run_sweep<Kind, W, Dim, ConductingRecord<Dim>, decltype(transport),
                             decltype(force), HeatFlow<Dim>, Continuity>;
        });
    }

    static constexpr Sweep<Dim> inviscid =
        run_sweep<Kind, W, Dim, InviscidRecord<Dim>, PlainTransport<Dim>, PressureForce<Dim>,
                  Continuity>;
    template <Work work = Work::mean>
    static constexpr Sweep<Dim> rubbing =
        run_sweep<Kind, W, Dim, RubbingRecord<Dim>, PlainTransport<Dim>, PressureForce<Dim, work>,
                  Continuity, PairFriction<Dim>, PairConduction>;

    /// Without friction and conduction their coefficients are 0.
    static constexpr Sweep<Dim> shifted =
        run_sweep<Kind, W, Dim, ShiftedRecord<Dim>, PressureForce<Dim>, Continuity,
                  ShiftingTransport<Dim, Mean>, PairFriction<Dim>, PairConduction>;

  private:
    template <Work work = Work::mean, bool torques = false, class Make>
    static Sweep<Dim> by_transport(const Scheme& scheme, const Make& make) {
        switch (scheme.transport) {
            case Transport::plain:
                return by_force<work, torques>(scheme, make, PlainTransport<Dim>{});
            case Transport::average:
                return by_force<work, torques>(scheme, make, AverageTransport<Dim>{});
            case Transport::monaghan:
            case Transport::shifting:  // of fluids: above
                break;
        }
        return by_force<work, torques>(scheme, make, MonaghanTransport<Dim, Mean>{});
    }
    template <Work work, bool torques, class Make, class Velocity>
    static Sweep<Dim> by_force(const Scheme& scheme, const Make& make, Velocity velocity) {
        if constexpr (Dim == 2 && work == Work::mean)
            if (scheme.balances_torques()) return make(velocity, TorqueSums<Dim>{});
        if constexpr (torques)
            return make(velocity, TorqueSums<Dim>{});
        else
            return make(velocity, StressForce<Dim, work>{});
    }
};

}  // namespace SPAM_LANES
}  // namespace spam

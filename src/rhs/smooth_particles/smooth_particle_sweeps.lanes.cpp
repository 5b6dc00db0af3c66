// SPDX-License-Identifier: GPL-3.0-or-later
// What is wanted most, as quick as it can be: Lucy's weight function, the arithmetic mean density.
#include "../sweeps/scheme_sweeps.hpp"

namespace spam {

template <int Dim, InstructionSet Level>
Sweeps<Dim> smooth_particle_sweeps(const Scheme& scheme, Matter matter) {
    if (scheme.work == Work::own) return own_work_sweeps<Dim, Level>(scheme, matter);
    if constexpr (Dim == 3)
        if (scheme.balances_torques()) return balanced_sweeps_in_space<Level>(scheme, matter);
    Sweeps<Dim> sweeps = general_sweeps<Dim, Level>(scheme, matter);
    if (scheme.kernel != Kernel::lucy) return sweeps;
    // On a line a fluid's general sweeps are as quick.
    if (sweeps.density != nullptr && (Dim > 1 || matter == Matter::solid))
        sweeps.density = run_sweep<LucysSweep, W, Dim, MotionRecord<Dim>, DensitySum>;
    if constexpr (Dim > 1) {
        using Forces = ForceSweeps<LucysSweep, Dim, ArithmeticMean>;
        if (matter == Matter::inviscid) sweeps.force = Forces::inviscid;
        if (matter == Matter::rubbing) sweeps.force = Forces::template rubbing<>;
    }
    if (matter != Matter::solid || scheme.mean_density != MeanDensityKind::arithmetic)
        return sweeps;
    sweeps.force = ForceSweeps<LucysSweep, Dim, ArithmeticMean>::solid(scheme);
    if constexpr (Dim == 2)
        if (scheme.balances_torques() && scheme.density != Density::chain_rule &&
            scheme.viscosity == 0.0) {
            sweeps.second =
                run_sweep<LucysSweep, W, Dim, TransportRecord<Dim>, BalancedStressForce<Dim>>;
            if (scheme.angular_momentum == AngularMomentum::torque_pair)
                sweeps.one_balance =
                    ForceSweeps<LucysSweep, Dim, ArithmeticMean>::one_balance(scheme);
        }
    return sweeps;
}

template Sweeps<1> smooth_particle_sweeps<1, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);
template Sweeps<2> smooth_particle_sweeps<2, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);
template Sweeps<3> smooth_particle_sweeps<3, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// Balanced torques in space: any weight function and mean density, and Lucy's with the arithmetic one for solids.
#include "../sweeps/scheme_sweeps.hpp"

namespace spam {
namespace {

using R = BalancedRecord<3>;

/// The sums that Newton's method asks for, and the forces.
template <class Kind>
void add_balance(const Scheme& scheme, Sweeps<3>& sweeps) {
    if (scheme.angular_momentum == AngularMomentum::torque_pair)
        sweeps.torques = run_sweep<Kind, W, 3, R, SpaceTorqueSums<true>>;
    sweeps.second = run_sweep<Kind, W, 3, R, BalancedStressForce<3>>;
}

}  // namespace

template <InstructionSet Level>
Sweeps<3> balanced_sweeps_in_space(const Scheme& scheme, Matter matter) {
    Sweeps<3> sweeps = general_sweeps<3, Level>(scheme, matter);
    const bool solid = matter == Matter::solid;
    if (solid && scheme.kernel == Kernel::lucy &&
        scheme.mean_density == MeanDensityKind::arithmetic) {
        sweeps.force = ForceSweeps<LucysSweep, 3, ArithmeticMean>::template solid<true>(scheme);
        add_balance<LucysSweep>(scheme, sweeps);
    } else {
        using Forces = ForceSweeps<GeneralSweep, 3, EitherMean>;
        sweeps.force = solid ? Forces::template solid<true>(scheme)
                             : Forces::template conducting<Work::mean, true>(scheme);
        add_balance<GeneralSweep>(scheme, sweeps);
    }
    // The chain rule costs next to nothing, and is there asked for or not.
    if (scheme.viscosity > 0.0)
        sweeps.second = run_sweep<GeneralSweep, W, 3, R, ChainRuleContinuity,
                                  BalancedStressForce<3>, ViscousForce<3, EitherMean>>;
    else if (scheme.density == Density::chain_rule)
        sweeps.second =
            run_sweep<GeneralSweep, W, 3, R, ChainRuleContinuity, BalancedStressForce<3>>;
    sweeps.numbers = std::max(sweeps.numbers, R::numbers);
    return sweeps;
}

template Sweeps<3> balanced_sweeps_in_space<InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);

}  // namespace spam

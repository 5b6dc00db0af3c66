// SPDX-License-Identifier: GPL-3.0-or-later
// Friction and conduction by pairs in a sweep of their own: any scheme, any weight function, several fluids.
#include "../sweeps/scheme_sweeps.hpp"

namespace spam {

template <int Dim, InstructionSet Level>
Sweep<Dim> friction_sweep() {
    return run_sweep<GeneralSweep, W, Dim, FrictionRecord<Dim>, PairFriction<Dim>, PairConduction>;
}

template Sweep<1> friction_sweep<1, InstructionSet::SPAM_LEVEL>();
template Sweep<2> friction_sweep<2, InstructionSet::SPAM_LEVEL>();
template Sweep<3> friction_sweep<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

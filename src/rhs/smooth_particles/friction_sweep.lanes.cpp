// SPDX-License-Identifier: GPL-3.0-or-later
// Friction and conduction by pairs in a sweep of their own: any scheme, any weight function, several fluids.
#include "../sweeps/scheme_sweeps.hpp"

namespace spam {

template <int Dim, InstructionSet Level>
Sweep<Dim> friction_sweep() {
    return run_sweep<GeneralSweep, W, Dim, FrictionRecord<Dim>, PairFriction<Dim>, PairConduction>;
}

#define SPAM_INSTANTIATE(D) template Sweep<D> friction_sweep<D, InstructionSet::SPAM_LEVEL>();
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_sweeps.hpp"

#include <spam/physics/contact.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {

template <int Dim, InstructionSet Level>
Sweeps<Dim> contact_sweeps() {
    return pair_sweeps<Level, GeneralSweep, Dim, BodyRecord<Dim>, ContactForce<Dim>,
                       ContactEnergy<Dim>>();
}

template Sweeps<1> contact_sweeps<1, InstructionSet::SPAM_LEVEL>();
template Sweeps<2> contact_sweeps<2, InstructionSet::SPAM_LEVEL>();
template Sweeps<3> contact_sweeps<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

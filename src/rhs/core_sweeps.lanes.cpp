// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack.hpp"
#include "term_sweeps.hpp"
#include <spam/physics/density_passes.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {

template <int Dim, InstructionSet Level>
Sweeps<Dim> core_sweeps() {
    constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
    Sweeps<Dim> sweeps{W, PointRecord<Dim>::numbers, pack<Dim, PointRecord<Dim>>};
    sweeps.force = run_sweep<GeneralSweep, W, Dim, PointRecord<Dim>, CoreForce<Dim>>;
    sweeps.energy = run_sweep<GeneralSweep, W, Dim, PointRecord<Dim>, CoreEnergy<Dim>>;
    return sweeps;
}

template Sweeps<1> core_sweeps<1, InstructionSet::SPAM_LEVEL>();
template Sweeps<2> core_sweeps<2, InstructionSet::SPAM_LEVEL>();
template Sweeps<3> core_sweeps<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

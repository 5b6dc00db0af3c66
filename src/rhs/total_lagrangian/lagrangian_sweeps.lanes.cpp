// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/deformation_gradient.hpp>
#include <spam/physics/reference_force.hpp>
#include <spam/physics/zero_energy_penalty.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);

/// Records are made by the term: positions move in a list that stays.
template <int Dim, class Kind>
Sweeps<Dim> sweeps_with() {
    Sweeps<Dim> sweeps{W, StressedRecord<Dim>::numbers};
    sweeps.gradient = run_sweep<Kind, W, Dim, ReferenceRecord<Dim>, DeformationGradient<Dim>>;
    sweeps.second = run_sweep<Kind, W, Dim, DeformedRecord<Dim>, ZeroEnergyPenalty<Dim>>;
    sweeps.force = run_sweep<Kind, W, Dim, StressedRecord<Dim>, ReferenceForce<Dim>>;
    sweeps.energy = run_sweep<Kind, W, Dim, DeformedRecord<Dim>, PenaltyEnergy<Dim>>;
    return sweeps;
}

}  // namespace

template <int Dim, InstructionSet Level>
Sweeps<Dim> lagrangian_sweeps(Kernel kernel) {
    return kernel == Kernel::lucy ? sweeps_with<Dim, LucysSweep>()
                                  : sweeps_with<Dim, GeneralSweep>();
}

template Sweeps<1> lagrangian_sweeps<1, InstructionSet::SPAM_LEVEL>(Kernel);
template Sweeps<2> lagrangian_sweeps<2, InstructionSet::SPAM_LEVEL>(Kernel);
template Sweeps<3> lagrangian_sweeps<3, InstructionSet::SPAM_LEVEL>(Kernel);

}  // namespace spam

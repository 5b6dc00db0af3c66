// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/cohesive_potential.hpp>
#include <spam/physics/density_passes.hpp>
#include <spam/physics/density_sum.hpp>
#include <spam/physics/long_range.hpp>
#include <spam/physics/pair_potential.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {

template <int Dim, InstructionSet Level>
Sweeps<Dim> core_sweeps() {
    return pair_sweeps<Level, GeneralSweep, Dim, PointRecord<Dim>, CoreForce<Dim>,
                       CoreEnergy<Dim>>();
}

template <int Dim, InstructionSet Level>
Sweeps<Dim> cohesive_sweeps() {
    return pair_sweeps<Level, GeneralSweep, Dim, PointRecord<Dim>,
                       DistanceForce<Dim, CohesivePotential>,
                       DistanceEnergy<Dim, CohesivePotential>>();
}

template <int Dim, InstructionSet Level>
Sweeps<Dim> long_range_sweeps() {
    return pair_sweeps<Level, GeneralSweep, Dim, ChargedRecord<Dim>, LongRangeForce<Dim>,
                       LongRangeEnergy<Dim>>();
}

template <int Dim, InstructionSet Level>
Sweeps<Dim> weight_potential_sweeps(Kernel kernel) {
    const auto of = []<class Kind>(Kind) {
        using R = PointRecord<Dim>;
        auto sweeps =
            pair_sweeps<Level, Kind, Dim, R, PairPotential<Dim>, PairPotentialEnergy<Dim>>();
        sweeps.density = run_sweep<Kind, native_lanes(Level), Dim, R, DensitySum>;
        return sweeps;
    };
    return kernel == Kernel::lucy ? of(LucysSweep{}) : of(GeneralSweep{});
}

#define SPAM_INSTANTIATE(D)                                                \
    template Sweeps<D> core_sweeps<D, InstructionSet::SPAM_LEVEL>();       \
    template Sweeps<D> cohesive_sweeps<D, InstructionSet::SPAM_LEVEL>();   \
    template Sweeps<D> long_range_sweeps<D, InstructionSet::SPAM_LEVEL>(); \
    template Sweeps<D> weight_potential_sweeps<D, InstructionSet::SPAM_LEVEL>(Kernel);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

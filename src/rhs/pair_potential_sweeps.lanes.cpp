// SPDX-License-Identifier: GPL-3.0-or-later
#include "pack.hpp"
#include "term_sweeps.hpp"
#include <spam/physics/density_sum.hpp>
#include <spam/physics/pair_potential.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {

template <int Dim, InstructionSet Level>
Sweeps<Dim> pair_potential_sweeps() {
    constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
    using R = PointRecord<Dim>;
    Sweeps<Dim> sweeps{W, R::numbers, pack<Dim, R>};
    sweeps.density = run_sweep<LucysSweep, W, Dim, R, DensitySum>;
    sweeps.force = run_sweep<LucysSweep, W, Dim, R, PairPotential<Dim>>;
    return sweeps;
}

template Sweeps<1> pair_potential_sweeps<1, InstructionSet::SPAM_LEVEL>();
template Sweeps<2> pair_potential_sweeps<2, InstructionSet::SPAM_LEVEL>();
template Sweeps<3> pair_potential_sweeps<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

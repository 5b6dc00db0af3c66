// SPDX-License-Identifier: GPL-3.0-or-later
// What is wanted most, as quick as it can be: Lucy's weight function, the arithmetic mean density.
#include "solid_sweeps.hpp"

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);

}  // namespace

template <int Dim, InstructionSet Level>
Sweeps<Dim> sweeps_of(const Scheme& scheme) {
    Sweeps<Dim> sweeps = general_sweeps<Dim, Level>(scheme);
    if (scheme.kernel != Kernel::lucy) return sweeps;
    if (sweeps.density != nullptr) sweeps.density = density_sweep<LucysSweep, W, Dim, Record<Dim>>;
    if (scheme.mean_density != MeanDensityKind::arithmetic) return sweeps;
    sweeps.first = FirstSweeps<LucysSweep, W, Dim, ArithmeticMean>::of(scheme);
    if constexpr (Dim == 2)
        if (balances(scheme) && scheme.density != Density::chain_rule && scheme.viscosity == 0.0)
            sweeps.second = second_sweep<LucysSweep, W, Dim, BalancedStressForce>;
    return sweeps;
}

template Sweeps<1> sweeps_of<1, InstructionSet::SPAM_LEVEL>(const Scheme&);
template Sweeps<2> sweeps_of<2, InstructionSet::SPAM_LEVEL>(const Scheme&);
template Sweeps<3> sweeps_of<3, InstructionSet::SPAM_LEVEL>(const Scheme&);

}  // namespace spam

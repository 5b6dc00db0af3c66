// SPDX-License-Identifier: GPL-3.0-or-later
// Any weight function and any mean density, each chosen at run time: compiled once for all of them.
#include "solid_sweeps.hpp"

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);

/// The scheme's second sweep. The chain rule costs next to nothing: with a viscous force it is always
/// there, and asked for or not (SweepOutput::rho_dot).
template <int Dim>
struct SecondSweeps {
    using Viscous = ViscousForce<Dim, EitherMean>;

    template <class... Passes>
    static constexpr Sweep<Dim> with = second_sweep<GeneralSweep, W, Dim, Passes...>;

    static Sweep<Dim> of(const Scheme& scheme) {
        const bool viscous = scheme.viscosity > 0.0;
        const bool chain_rule = scheme.density == Density::chain_rule;
        if constexpr (Dim == 2)
            if (balances(scheme))
                return viscous      ? with<ChainRuleContinuity, BalancedStressForce, Viscous>
                       : chain_rule ? with<ChainRuleContinuity, BalancedStressForce>
                                    : with<BalancedStressForce>;
        if (viscous) return with<ChainRuleContinuity, Viscous>;
        return chain_rule ? with<ChainRuleContinuity> : nullptr;
    }
};

}  // namespace

template <int Dim, InstructionSet Level>
Sweeps<Dim> general_sweeps(const Scheme& scheme) {
    Sweeps<Dim> sweeps{W};
    if (scheme.density == Density::summed)
        sweeps.density = density_sweep<GeneralSweep, W, Dim, Record<Dim>>;
    sweeps.first = FirstSweeps<GeneralSweep, W, Dim, EitherMean>::of(scheme);
    sweeps.second = SecondSweeps<Dim>::of(scheme);
    return sweeps;
}

template Sweeps<1> general_sweeps<1, InstructionSet::SPAM_LEVEL>(const Scheme&);
template Sweeps<2> general_sweeps<2, InstructionSet::SPAM_LEVEL>(const Scheme&);
template Sweeps<3> general_sweeps<3, InstructionSet::SPAM_LEVEL>(const Scheme&);

}  // namespace spam

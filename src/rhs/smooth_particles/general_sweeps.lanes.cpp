// SPDX-License-Identifier: GPL-3.0-or-later
// Any weight function and any mean density, each chosen at run time: compiled once for all of them.
#include "../sweeps/scheme_sweeps.hpp"

namespace spam {
namespace {

/// The scheme's second sweep, of TransportRecord or ViscousRecord. The chain rule costs next to nothing:
/// with a viscous force it is always there, and asked for or not (SweepOutput::rho_dot).
template <int Dim, class R>
struct SecondSweeps {
    using Viscous = ViscousForce<Dim, EitherMean>;

    template <class... Passes>
    static constexpr Sweep<Dim> with = run_sweep<GeneralSweep, W, Dim, R, Passes...>;

    static Sweep<Dim> viscous(const Scheme& scheme) {
        if constexpr (Dim == 2)
            if (scheme.balances_torques())
                return with<ChainRuleContinuity, BalancedStressForce<Dim>, Viscous>;
        return with<ChainRuleContinuity, Viscous>;
    }
    static Sweep<Dim> inviscid(const Scheme& scheme) {
        const bool chain_rule = scheme.density == Density::chain_rule;
        if constexpr (Dim == 2)
            if (scheme.balances_torques())
                return chain_rule ? with<ChainRuleContinuity, BalancedStressForce<Dim>>
                                  : with<BalancedStressForce<Dim>>;
        return chain_rule ? with<ChainRuleContinuity> : nullptr;
    }
};

template <int Dim>
Sweep<Dim> second_sweep(const Scheme& scheme, Matter matter) {
    if (!(scheme.viscosity > 0.0)) return SecondSweeps<Dim, TransportRecord<Dim>>::inviscid(scheme);
    return matter == Matter::conducting ? SecondSweeps<Dim, ViscousRecord<Dim>>::viscous(scheme)
                                        : SecondSweeps<Dim, TransportRecord<Dim>>::viscous(scheme);
}

}  // namespace

template <int Dim, InstructionSet Level>
Sweeps<Dim> general_sweeps(const Scheme& scheme, Matter matter) {
    Sweeps<Dim> sweeps{W, 0};
    if (scheme.density == Density::summed)
        sweeps.density = run_sweep<GeneralSweep, W, Dim, MotionRecord<Dim>, DensitySum>;
    using Forces = ForceSweeps<GeneralSweep, Dim, EitherMean>;
    if (matter == Matter::inviscid || matter == Matter::rubbing || matter == Matter::shifted) {
        sweeps.pack = pack<Dim, InviscidRecord<Dim>>;
        sweeps.force = matter == Matter::inviscid  ? Forces::inviscid
                       : matter == Matter::rubbing ? Forces::template rubbing<>
                                                   : Forces::shifted;
    } else {
        // A fluid's stress comes later.
        using Densities = typename MotionRecord<Dim>::template And<column::Density>;
        sweeps.pack = matter == Matter::solid ? pack<Dim, Record<Dim>> : pack<Dim, Densities>;
        sweeps.second = second_sweep<Dim>(scheme, matter);
        sweeps.force = matter == Matter::solid ? Forces::solid(scheme) : Forces::conducting(scheme);
    }
    if (matter == Matter::conducting)
        sweeps.gradient =
            run_sweep<GeneralSweep, W, Dim, ConductingRecord<Dim>,
                      VelocityGradient<Dim, EitherMean>, TemperatureGradient<Dim, EitherMean>>;
    const int first = matter == Matter::inviscid     ? InviscidRecord<Dim>::numbers
                      : matter == Matter::rubbing    ? RubbingRecord<Dim>::numbers
                      : matter == Matter::shifted    ? ShiftedRecord<Dim>::numbers
                      : matter == Matter::conducting ? ConductingRecord<Dim>::numbers
                                                     : Record<Dim>::numbers;
    const int later =
        matter == Matter::conducting ? ViscousRecord<Dim>::numbers : TransportRecord<Dim>::numbers;
    sweeps.numbers = sweeps.second != nullptr ? std::max(first, later) : first;
    return sweeps;
}

template Sweeps<1> general_sweeps<1, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);
template Sweeps<2> general_sweeps<2, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);
template Sweeps<3> general_sweeps<3, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);

}  // namespace spam

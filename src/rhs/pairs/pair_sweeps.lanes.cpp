// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/cohesive_potential.hpp>
#include <spam/physics/contact_potential.hpp>
#include <spam/physics/density_passes.hpp>
#include <spam/physics/density_sum.hpp>
#include <spam/physics/fick_flux.hpp>
#include <spam/physics/long_range.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/physics/pair_potential.hpp>
#include <spam/physics/viscosity.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {
namespace {

/// The only pass of its sweep.
template <int Dim>
struct ViscousForceAlone : ViscousForce<Dim, ArithmeticMean> {
    static ViscousForceAlone with(const PassConstants& c) {
        return {ViscousForce<Dim, ArithmeticMean>::with(c)};
    }
    template <class To, class T>
    static void store(const To& to, const ForceSums<Dim, T>& sums) {
        sums.store(to);
    }
};

}  // namespace

template <int Dim, InstructionSet Level>
Sweeps<Dim> viscous_sweeps() {
    using R = typename MotionRecord<Dim>::template And<column::Density>;
    return pair_sweeps<Level, GeneralSweep, Dim, R, ViscousForceAlone<Dim>>();
}

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
Sweeps<Dim> species_sweeps() {
    constexpr int W = native_lanes(Level);
    using R = SpeciesRecord<Dim>;
    Sweeps<Dim> sweeps{W, R::numbers, pack<Dim, PointRecord<Dim>>};
    sweeps.density = run_sweep<GeneralSweep, W, Dim, PointRecord<Dim>, DensitySum>;
    sweeps.gradient = run_sweep<GeneralSweep, W, Dim, ConcentrationRecord<Dim>, FickFlux<Dim>>;
    sweeps.force = run_sweep<GeneralSweep, W, Dim, R, HeatFlow<Dim>>;
    return sweeps;
}

template <int Dim, InstructionSet Level>
Sweeps<Dim> contact_sweeps() {
    return pair_sweeps<Level, GeneralSweep, Dim, ContactRecord<Dim>, ContactForce<Dim>,
                       ContactEnergy<Dim>>();
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
    template Sweeps<D> viscous_sweeps<D, InstructionSet::SPAM_LEVEL>();    \
    template Sweeps<D> core_sweeps<D, InstructionSet::SPAM_LEVEL>();       \
    template Sweeps<D> cohesive_sweeps<D, InstructionSet::SPAM_LEVEL>();   \
    template Sweeps<D> contact_sweeps<D, InstructionSet::SPAM_LEVEL>();    \
    template Sweeps<D> long_range_sweeps<D, InstructionSet::SPAM_LEVEL>(); \
    template Sweeps<D> species_sweeps<D, InstructionSet::SPAM_LEVEL>();    \
    template Sweeps<D> weight_potential_sweeps<D, InstructionSet::SPAM_LEVEL>(Kernel);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

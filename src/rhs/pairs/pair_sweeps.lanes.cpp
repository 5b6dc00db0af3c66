// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/contact_potential.hpp>
#include <spam/physics/mean_density.hpp>
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
Sweeps<Dim> contact_sweeps() {
    return pair_sweeps<Level, GeneralSweep, Dim, ContactRecord<Dim>, ContactForce<Dim>,
                       ContactEnergy<Dim>>();
}

#define SPAM_INSTANTIATE(D)                                             \
    template Sweeps<D> viscous_sweeps<D, InstructionSet::SPAM_LEVEL>(); \
    template Sweeps<D> contact_sweeps<D, InstructionSet::SPAM_LEVEL>();
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/curvature_strength.hpp>
#include <spam/physics/density_passes.hpp>
#include <spam/physics/embedded_energy.hpp>
#include <spam/physics/surface_tension.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);

template <int Dim, class... Terms>
Sweeps<Dim> sweeps_of_terms() {
    using R = SlopeRecord<Dim, double, Terms...>;
    Sweeps<Dim> sweeps{W, R::numbers, pack<Dim, PointRecord<Dim>>};
    sweeps.density =
        run_sweep<GeneralSweep, W, Dim, PointRecord<Dim>, DensityFields<Dim, Terms...>>;
    sweeps.force = run_sweep<GeneralSweep, W, Dim, R, DensityForces<Dim, Terms...>>;
    sweeps.energy = run_sweep<GeneralSweep, W, Dim, PointRecord<Dim>, CoreEnergy<Dim>>;
    return sweeps;
}

}  // namespace

template <int Dim, InstructionSet Level>
Sweeps<Dim> density_potential_sweeps(bool shape) {
    if (!shape) return sweeps_of_terms<Dim, DensityItself>();
    if constexpr (Dim == 1)
        return sweeps_of_terms<Dim, DensityItself, SurfaceTension>();
    else
        return sweeps_of_terms<Dim, DensityItself, SurfaceTension, CurvatureStrength>();
}

template Sweeps<1> density_potential_sweeps<1, InstructionSet::SPAM_LEVEL>(bool);
template Sweeps<2> density_potential_sweeps<2, InstructionSet::SPAM_LEVEL>(bool);
template Sweeps<3> density_potential_sweeps<3, InstructionSet::SPAM_LEVEL>(bool);

}  // namespace spam

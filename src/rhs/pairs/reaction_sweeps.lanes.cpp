// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/density_sum.hpp>
#include <spam/physics/fick_flux.hpp>
#include <spam/physics/mean_density.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {

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

#define SPAM_INSTANTIATE(D) template Sweeps<D> species_sweeps<D, InstructionSet::SPAM_LEVEL>();
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

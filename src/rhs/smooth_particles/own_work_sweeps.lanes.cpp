// SPDX-License-Identifier: GPL-3.0-or-later
// Fluids whose particles take the work of their own stress: any weight function and mean density.
#include "../sweeps/scheme_sweeps.hpp"

namespace spam {

template <int Dim, InstructionSet Level>
Sweeps<Dim> own_work_sweeps(const Scheme& scheme, Matter matter) {
    Sweeps<Dim> sweeps = general_sweeps<Dim, Level>(scheme, matter);
    using Forces = ForceSweeps<GeneralSweep, Dim, EitherMean>;
    if (matter == Matter::rubbing) {
        sweeps.force = Forces::template rubbing<Work::own>;
        return sweeps;
    }
    sweeps.force = Forces::template conducting<Work::own>(scheme);
    sweeps.gradient =
        run_sweep<GeneralSweep, W, Dim, ConductingRecord<Dim>, VelocityGradient<Dim, OwnDensity>,
                  TemperatureGradient<Dim, EitherMean>>;
    return sweeps;
}

template Sweeps<1> own_work_sweeps<1, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);
template Sweeps<2> own_work_sweeps<2, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);
template Sweeps<3> own_work_sweeps<3, InstructionSet::SPAM_LEVEL>(const Scheme&, Matter);

}  // namespace spam

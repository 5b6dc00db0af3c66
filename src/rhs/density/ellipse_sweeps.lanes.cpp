// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/ellipse.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {

/// As own_range_sweeps(): the pair's own weight is not asked for.
template <int Dim, InstructionSet Level>
Sweeps<Dim> ellipse_sweeps() {
    constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
    using R = EllipseRecord<Dim>;
    Sweeps<Dim> sweeps{W, R::numbers, pack<Dim, R>};
    sweeps.density = run_sweep<GeneralSweep, W, Dim, ShapedRecord<Dim>, EllipseSums<Dim>>;
    sweeps.force = run_sweep<GeneralSweep, W, Dim, PullingRecord<Dim>, EllipseForce<Dim>>;
    return sweeps;
}

#define SPAM_INSTANTIATE(D) template Sweeps<D> ellipse_sweeps<D, InstructionSet::SPAM_LEVEL>();
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

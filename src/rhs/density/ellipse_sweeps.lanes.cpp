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

template Sweeps<1> ellipse_sweeps<1, InstructionSet::SPAM_LEVEL>();
template Sweeps<2> ellipse_sweeps<2, InstructionSet::SPAM_LEVEL>();
template Sweeps<3> ellipse_sweeps<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

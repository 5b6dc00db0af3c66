// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/variable_range.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {

/// The pair's own weight is not asked for: particles have ranges of their own, and the sweep's weight
/// function is the one of range 1.
template <int Dim, InstructionSet Level>
Sweeps<Dim> own_range_sweeps() {
    constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
    using R = RangeRecord<Dim>;
    Sweeps<Dim> sweeps{W, R::numbers, pack<Dim, R>};
    sweeps.density = run_sweep<GeneralSweep, W, Dim, R, OwnRangeSums<Dim>>;
    sweeps.force = run_sweep<GeneralSweep, W, Dim, R, BothRangesForce<Dim>>;
    return sweeps;
}

template Sweeps<1> own_range_sweeps<1, InstructionSet::SPAM_LEVEL>();
template Sweeps<2> own_range_sweeps<2, InstructionSet::SPAM_LEVEL>();
template Sweeps<3> own_range_sweeps<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "../sweeps/term_sweeps.hpp"
#include <spam/physics/pair_friction.hpp>
#include <spam/physics/variable_range.hpp>
#include <spam/rhs/run_sweep.hpp>

namespace spam {

/// The pair's own weight is not asked for: particles have ranges of their own, and the sweep's weight
/// function is the one of range 1.
template <int Dim, InstructionSet Level>
Sweeps<Dim> own_range_sweeps(bool rubbing) {
    constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
    using R = RangeRecord<Dim>;
    using Rubbing = RubbingRangeRecord<Dim>;
    Sweeps<Dim> sweeps{W, R::numbers, pack<Dim, R>};
    sweeps.density = run_sweep<GeneralSweep, W, Dim, R, OwnRangeSums<Dim>>;
    sweeps.force = run_sweep<GeneralSweep, W, Dim, R, BothRangesForce<Dim>>;
    if (!rubbing) return sweeps;
    sweeps.numbers = Rubbing::numbers;
    sweeps.pack = pack<Dim, Rubbing>;
    sweeps.second = run_sweep<GeneralSweep, W, Dim, Rubbing, OfBothRanges<Dim, PairFriction<Dim>>,
                              OfBothRanges<Dim, PairConduction>>;
    return sweeps;
}

template Sweeps<1> own_range_sweeps<1, InstructionSet::SPAM_LEVEL>(bool);
template Sweeps<2> own_range_sweeps<2, InstructionSet::SPAM_LEVEL>(bool);
template Sweeps<3> own_range_sweeps<3, InstructionSet::SPAM_LEVEL>(bool);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "range_sweeps.hpp"

#include <spam/neighbors/sweep.hpp>
#include <spam/physics/variable_range.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);

/// The pair's own weight is not asked for: particles have ranges of their own.
template <int Dim, class Pass, class Store>
void sweep_ranges(const RangeInput<Dim>& in, const Store& store_sums) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        const Box<Dim> box = *in.box;  // a copy that no store can be suspected to change
        const std::tuple<Pass> pass{Pass{*in.unit}};
        sweep_block<W, Dim, RangeRecord<Dim>, Pass>(
            in.list, begin, end, std::get<0>(pass).unit, box, in.records,
            [&](std::size_t slot, const auto&, const auto& sums) {
                for_each_lane<W>(in.list, slot,
                                 [&](int l, std::size_t i) { store_sums(sums, l, i); });
            },
            pass);
    });
}

template <int Dim>
void own_sums(const RangeInput<Dim>& in, const RangeOutput<Dim>& out) {
    sweep_ranges<Dim, OwnRangeSums<Dim>>(in, [&](const auto& sums, int l, std::size_t i) {
        out.spread[i] = lane(sums.spread, l);
        out.approach[i] = lane(sums.approach, l);
    });
}

template <int Dim>
void force(const RangeInput<Dim>& in, const RangeOutput<Dim>& out) {
    sweep_ranges<Dim, BothRangesForce<Dim>>(in, [&](const auto& sums, int l, std::size_t i) {
        for (int a = 0; a < Dim; ++a)
            out.v_dot[i * Dim + static_cast<std::size_t>(a)] = lane(sums.v_dot[a], l);
    });
}

}  // namespace

template <int Dim, InstructionSet Level>
RangeSweeps<Dim> range_sweeps() {
    return {W, nullptr, own_sums<Dim>, force<Dim>};
}

template RangeSweeps<1> range_sweeps<1, InstructionSet::SPAM_LEVEL>();
template RangeSweeps<2> range_sweeps<2, InstructionSet::SPAM_LEVEL>();
template RangeSweeps<3> range_sweeps<3, InstructionSet::SPAM_LEVEL>();

}  // namespace spam

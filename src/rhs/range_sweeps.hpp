// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pack.hpp"
#include <spam/core/instruction_set.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/box.hpp>
#include <spam/neighbors/cluster_view.hpp>

namespace spam {

/// What the sweeps of VariableRangeModel read ...
template <int Dim>
struct RangeInput {
    ClusterView list;
    Records records;  ///< RangeRecord
    const GeneralWeight<Dim>* unit;
    const Box<Dim>* box;
};

/// ... and write, by number of particle.
template <int Dim>
struct RangeOutput {
    double* spread = nullptr;    ///< N, OwnRangeSums
    double* approach = nullptr;  ///< N
    double* v_dot = nullptr;     ///< Dim x N
};

template <int Dim>
using RangeSweep = void (*)(const RangeInput<Dim>&, const RangeOutput<Dim>&);

/// Compiled for an instruction set.
template <int Dim>
struct RangeSweeps {
    int width;                           ///< of the clusters they need
    Pack<Dim> pack = nullptr;            ///< makes x, v, m of their records
    RangeSweep<Dim> own_sums = nullptr;  ///< needs inverse_range
    RangeSweep<Dim> force = nullptr;     ///< needs pull too
};

/// Defined in range_sweeps.lanes.cpp for every level.
template <int Dim, InstructionSet Level>
RangeSweeps<Dim> range_sweeps();

}  // namespace spam

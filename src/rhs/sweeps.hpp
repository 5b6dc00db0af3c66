// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pack.hpp"
#include <spam/core/instruction_set.hpp>
#include <spam/core/tensor.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/box.hpp>
#include <spam/neighbors/cluster_view.hpp>
#include <spam/physics/pass_constants.hpp>
#include <spam/physics/scheme.hpp>

namespace spam {

/// What the sweeps of a right-hand side read ...
template <int Dim>
struct SweepInput {
    ClusterView list;
    Records records;  ///< TransportRecord where there is a second sweep, else Record
    double range;     ///< of the weight function
    const Box<Dim>* box;
    const GeneralWeight<Dim>* weight = nullptr;  ///< not read by what is compiled for Lucy's
    PassConstants constants{};
};

/// ... and write, by number of particle. What is null is not wanted.
template <int Dim>
struct SweepOutput {
    double* x_dot = nullptr;            ///< Dim x N, the transport velocity
    double* v_dot = nullptr;            ///< Dim x N
    double* rho_dot = nullptr;          ///< N, continuity first, chain rule second
    double* e_dot = nullptr;            ///< N
    double* rho = nullptr;              ///< N, the summed density
    double* positive_torque = nullptr;  ///< N, TorqueSums
    double* negative_torque = nullptr;  ///< N

    /// Called with the velocity gradients of some particles and their numbers, from any thread.
    void (*stress_rates)(const void* context, const std::uint32_t* particle, std::size_t count,
                         const Mat<Dim>* grad_v) = nullptr;
    const void* context = nullptr;
};

template <int Dim>
using Sweep = void (*)(const SweepInput<Dim>&, const SweepOutput<Dim>&);

/// The sweeps of a scheme, compiled for an instruction set: run-time choices become functions once
/// per model.
template <int Dim>
struct Sweeps {
    int width;                     ///< of the clusters they need
    Pack<Dim> pack = nullptr;      ///< makes their records
    Sweep<Dim> density = nullptr;  ///< null where density is part of y
    Sweep<Dim> first = nullptr;
    Sweep<Dim> second = nullptr;  ///< null where the first finds everything
};

/// The best there are, without `pack`. Defined in sweeps.lanes.cpp for every level.
template <int Dim, InstructionSet Level>
Sweeps<Dim> sweeps_of(const Scheme& scheme);

/// For any scheme, with the weight function and the mean density chosen at run time, of records that
/// hold EitherMean's number; in general_sweeps.lanes.cpp.
template <int Dim, InstructionSet Level>
Sweeps<Dim> general_sweeps(const Scheme& scheme);

/// For PairPotentialModel, of PointRecord, in potential_sweeps.lanes.cpp.
template <int Dim, InstructionSet Level>
Sweeps<Dim> potential_sweeps();

}  // namespace spam

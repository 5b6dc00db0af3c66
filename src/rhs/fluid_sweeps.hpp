// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pack.hpp"
#include <spam/core/instruction_set.hpp>
#include <spam/core/tensor.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/neighbors/box.hpp>
#include <spam/neighbors/cluster_view.hpp>
#include <spam/physics/scheme.hpp>

namespace spam {

/// What the sweeps of FluidModel read ...
template <int Dim>
struct FluidInput {
    ClusterView list;
    Records records;  ///< InviscidRecord, or ConductingRecord filled in sweep by sweep
    const GeneralWeight<Dim>* weight;
    const Box<Dim>* box;
};

/// ... and write, by number of particle. What is null is not wanted.
template <int Dim>
struct FluidOutput {
    double* rho = nullptr;      ///< N, the summed density
    double* v_dot = nullptr;    ///< Dim x N
    double* rho_dot = nullptr;  ///< N, by continuity
    double* e_dot = nullptr;    ///< N

    /// Called with the gradients of velocity and temperature of some slots (none of them a lane that
    /// only fills up its cluster) and the particles in them, from any thread.
    void (*gradients)(const void* context, std::size_t first_slot, const std::uint32_t* particle,
                      std::size_t count, const Mat<Dim>* grad_v, const Vec<Dim>* grad_T) = nullptr;
    const void* context = nullptr;
};

template <int Dim>
using FluidSweep = void (*)(const FluidInput<Dim>&, const FluidOutput<Dim>&);

/// Compiled for an instruction set.
template <int Dim>
struct FluidSweeps {
    int width;                           ///< of the clusters they need
    Pack<Dim> pack = nullptr;            ///< makes x, v, m of their records
    FluidSweep<Dim> density = nullptr;   ///< needs x and m
    FluidSweep<Dim> gradient = nullptr;  ///< needs GradientRecord, calls `gradients`; may be null
    FluidSweep<Dim> force = nullptr;     ///< v_dot, rho_dot, e_dot
};

/// Defined in fluid_sweeps.lanes.cpp for every level. `conducting`: with friction or conduction.
template <int Dim, InstructionSet Level>
FluidSweeps<Dim> fluid_sweeps(bool conducting, MeanDensityKind mean);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sweeps.hpp"

namespace spam {

/// What the sweeps of FluidModel write, by number of particle. Their records are those of SweepInput,
/// InviscidRecord, or ConductingRecord filled in sweep by sweep. What is null is not wanted.
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
using FluidSweep = void (*)(const SweepInput<Dim>&, const FluidOutput<Dim>&);

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
FluidSweeps<Dim> fluid_sweeps(bool conducting);

}  // namespace spam

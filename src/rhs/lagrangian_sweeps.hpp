// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sweeps.hpp"

namespace spam {

/// What the sweeps of TotalLagrangianModel write. Its records are those of SweepInput, StressedRecord
/// by slot: each sweep fills in what the next one reads.
template <int Dim>
struct LagrangianOutput {
    double* records;
    double* v_dot = nullptr;       ///< Dim x N
    double* energy = nullptr;      ///< N, of the penalty
    double inverse_density = 0.0;  ///< 1/rho_0 = V_i/m_i
    double penalty = 0.0;          ///< kappa lambda

    /// Called with slots whose F is known, from any thread: to write their P to where B will be.
    void (*stresses)(void* context, std::size_t first_slot, std::size_t count) = nullptr;
    void* context = nullptr;
};

template <int Dim>
using LagrangianSweep = void (*)(const SweepInput<Dim>&, const LagrangianOutput<Dim>&);

/// Compiled for an instruction set.
template <int Dim>
struct LagrangianSweeps {
    int width;                      ///< of the clusters they need
    LagrangianSweep<Dim> gradient;  ///< F, then calls stresses
    LagrangianSweep<Dim> penalty;   ///< v_dot of the penalty; P becomes B = (P - M/V) K^t
    LagrangianSweep<Dim> force;     ///< adds the v_dot of B
    LagrangianSweep<Dim> energy;    ///< of the penalty
};

/// Defined in lagrangian_sweeps.lanes.cpp for every level.
template <int Dim, InstructionSet Level>
LagrangianSweeps<Dim> lagrangian_sweeps();

}  // namespace spam

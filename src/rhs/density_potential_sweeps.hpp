// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sweeps.hpp"
#include <spam/kernel/general_weight.hpp>
#include <spam/physics/core_potential.hpp>

namespace spam {

/// The records of DensityPotentialModel: x and m (PointRecord), then rho and, where anything but the
/// density and the core acts, g and D (not on a line, where D is zero). The sweep of fields writes these;
/// the model puts in their place the slopes that the sweep of forces reads.
template <int Dim>
struct DensityRecordPlaces {
    static constexpr std::size_t mass = Dim, rho = Dim + 1, g = Dim + 2, D = 2 * Dim + 2;
    static constexpr std::size_t of_density = g,
                                 of_all = Dim == 1 ? D : D + std::size_t{symmetric_size(Dim)};
};

/// What the sweeps of DensityPotentialModel need besides the list, and what they write.
template <int Dim>
struct DensityPotentialOutput {
    const GeneralWeight<Dim>& weight;
    CorePotential core;
    double* records;
    double* v_dot = nullptr;   ///< Dim x N
    double* energy = nullptr;  ///< N, the core's: half of each pair's
};

template <int Dim>
using DensityPotentialSweep = void (*)(const SweepInput<Dim>&, const DensityPotentialOutput<Dim>&);

/// Compiled for an instruction set.
template <int Dim>
struct DensityPotentialSweeps {
    int width;                          ///< of the clusters they need
    DensityPotentialSweep<Dim> fields;  ///< rho, g and D into the records
    DensityPotentialSweep<Dim> forces;  ///< v_dot of the slopes, and of the core
    DensityPotentialSweep<Dim> energy;  ///< of the core
};

/// Defined in density_potential_sweeps.lanes.cpp for every level. With `shape`, for g and D as well.
template <int Dim, InstructionSet Level>
DensityPotentialSweeps<Dim> density_potential_sweeps(bool shape);

}  // namespace spam

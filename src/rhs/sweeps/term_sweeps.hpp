// SPDX-License-Identifier: GPL-3.0-or-later
// Where the terms of models find their sweeps: each function is defined in a *.lanes.cpp, for every
// instruction set.
#pragma once

#include "../../core/levels.hpp"
#include <spam/core/instruction_set.hpp>
#include <spam/physics/scheme.hpp>
#include <spam/rhs/sweeps.hpp>

namespace spam {

/// Of what kind the particles of a smooth-particle scheme are: where their A = sigma/rho^2 comes from.
enum class Matter {
    solid,       ///< from the stress in y; the velocity gradients of the force sweep give its rate
    inviscid,    ///< a pressure, known before any sweep; particles move with their own velocity
    rubbing,     ///< the same, with friction and conduction of pairs of one fluid
    shifted,     ///< the same or without them, by particles that are shifted
    conducting,  ///< pressure, friction and conduction, from a sweep of gradients
};

/// Any scheme, with Lucy's weight function and the arithmetic mean density as quick as they can be.
template <int Dim, InstructionSet Level>
Sweeps<Dim> smooth_particle_sweeps(const Scheme& scheme, Matter matter);
/// The same with weight function and mean density chosen at run time, compiled once for all of them.
template <int Dim, InstructionSet Level>
Sweeps<Dim> general_sweeps(const Scheme& scheme, Matter matter);

/// The same for schemes that balance torques in space.
template <InstructionSet Level>
Sweeps<3> balanced_sweeps_in_space(const Scheme& scheme, Matter matter);

/// The same of rubbing and conducting matter for schemes with Work::own.
template <int Dim, InstructionSet Level>
Sweeps<Dim> own_work_sweeps(const Scheme& scheme, Matter matter);

/// Friction and conduction by pairs on top of any scheme, of FrictionRecord.
template <int Dim, InstructionSet Level>
Sweep<Dim> friction_sweep();

/// Ranges that follow the density, of RangeRecord; with friction and conduction of RubbingRangeRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> own_range_sweeps(bool rubbing);

/// Ellipses, of EllipseRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> ellipse_sweeps();

/// Potentials of the density, of SlopeRecord. With `shape`, for gradient and curvature as well.
template <int Dim, InstructionSet Level>
Sweeps<Dim> density_potential_sweeps(bool shape);

/// A weight function as pair potential, of PointRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> weight_potential_sweeps(Kernel kernel);

/// Artificial viscosity as a term of its own, of MotionRecord and the density.
template <int Dim, InstructionSet Level>
Sweeps<Dim> viscous_sweeps();

/// A core, of PointRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> core_sweeps();
/// The cohesive potential, of PointRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> cohesive_sweeps();

/// Long-range forces, of ChargedRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> long_range_sweeps();

/// A species that spreads and reacts, of SpeciesRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> species_sweeps();

/// Contact, of ContactRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> contact_sweeps();

/// A total-Lagrangian solid, of StressedRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> lagrangian_sweeps(Kernel kernel);

/// choose(level) for the processor's own instruction set.
template <class Choose>
auto best_sweeps(const Choose& choose) {
    return at_level(instruction_set(), choose);
}

}  // namespace spam

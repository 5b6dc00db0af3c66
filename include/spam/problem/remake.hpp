// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/population.hpp>
#include <spam/diagnostics/invariants.hpp>

#include <vector>

namespace spam {

/// How motion goes on with other particles (core/population.hpp): y of the model made of them, and what the
/// change of particles did to the invariants.
template <int Dim>
struct Remade {
    std::vector<double> y;
    Invariants<Dim> before, after;
};

/// `y` of `model` and what it remembers beside it (core/memory.hpp) carried over to `next`, which is made of
/// population.particles and of the same laws in the same order. Each field passes as it says (Share): most as
/// means by mass, positions with their offsets, velocities by momentum, heat as a sum; where particles have
/// energies a merged one gets the kinetic energy that its parts had about their centre. Vectors X_kj of bonds
/// become those of the new particles by the old F (Memory::bonds), broken pairs stay broken, and new neighbours
/// enter without misfit. Where several go into two (Repopulation::merge with a d) these turn about each other with the
/// angular momentum of their parts, and what is left of the motion is their heat. Ranges that follow the density are
/// found anew with it.
///
/// A split keeps mass, momentum and angular momentum to rounding, and the energy wherever the strain is that of
/// one F: children lie at x + d and at X + F^-1 d, so that turned and stretched bodies store what they stored.
/// Else a potential changes with the places of particles: where particles carry an energy those that are split or
/// merged pay for it, else the change is refused; what material vectors lose is their heat. Merging into one loses
/// the angular momentum that the parts had about their centre: a particle has no spin, and to give it to others
/// would take energy that nothing gives. All that changes is in Model::gains() of `next`, so that the balances
/// of a run (Invariants::energy_balance() and the like) go on without a jump; the rest is after - before.
///
/// In a periodic box parts are taken by their nearest images. Scales of the layout are those of `model`.
/// The integrator is made anew from there: Motion(next, remade.y, options, t).
///
/// Throws InputError where `next` has other laws; where a particle of a law that remembers places in the material
/// was split without its deformation, or merged without the model's box; where springs, which have one length, or
/// corners of elements, of which there are four, are split or merged; where particles that have broken are merged with
/// others, or of different bodies that have material vectors; where material vectors would be merged into two; where
/// the energy of a fluid or a potential is a function of the density or the places and nothing can pay for its change.
template <int Dim>
Remade<Dim> remake(Model<Dim>& model, std::span<const double> y, const Population<Dim>& population,
                   Model<Dim>& next);

/// The d for Repopulation::merge(group, d): as far from the centre of mass as makes the moment of inertia of the two,
/// seen along the angular momentum, that of the group, and along its longest axis. Then no other way of keeping the
/// angular momentum takes less energy, and the two have more heat than the group or as much. Zero where all are at one
/// place.
template <int Dim>
Point<Dim> twin_offset(const Model<Dim>& model, std::span<const double> y,
                       const std::vector<std::size_t>& group);

/// `y` of `model` as the start of a run of its own of `next`, which has the same particles in another
/// box, with other laws or other externals: the fields that both have, accounts and other fields at zero.
/// Throws InputError where the particles are others. Scales of the layout are those of `next`.
template <int Dim>
std::vector<double> restated(const Model<Dim>& model, std::span<const double> y,
                             const Model<Dim>& next);

}  // namespace spam

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

/// `y` of `model` carried over to `next`, which is made of population.particles: fields by mass, positions
/// with their offsets, velocities by momentum; where particles have energies a merged one gets the kinetic
/// energy that its parts had about their centre. Then mass, momentum and energy are kept to rounding
/// wherever nothing is removed and nothing but particles' own energies counts; a potential changes with
/// the places of particles, and merging loses the angular momentum that the parts had about their centre.
/// Whatever changes is booked in the accounts, where y has them, so that the balances of a run
/// (Invariants::energy_balance() and the like) go on without a jump; the rest is after - before.
/// In a periodic box parts are taken by their nearest images. Scales of the layout are those of `model`.
/// The integrator is made anew from there: Motion(next, remade.y, options, t).
template <int Dim>
Remade<Dim> remake(const Model<Dim>& model, std::span<const double> y,
                   const Population<Dim>& population, Model<Dim>& next);

/// `y` of `model` as the start of a run of its own of `next`, which has the same particles in another
/// box, with other laws or other externals: the fields that both have, accounts and other fields at zero.
/// Throws InputError where the particles are others. Scales of the layout are those of `next`.
template <int Dim>
std::vector<double> restated(const Model<Dim>& model, std::span<const double> y,
                             const Model<Dim>& next);

extern template Remade<1> remake(const Model<1>&, std::span<const double>, const Population<1>&,
                                 Model<1>&);
extern template Remade<2> remake(const Model<2>&, std::span<const double>, const Population<2>&,
                                 Model<2>&);
extern template Remade<3> remake(const Model<3>&, std::span<const double>, const Population<3>&,
                                 Model<3>&);
extern template std::vector<double> restated(const Model<1>&, std::span<const double>,
                                             const Model<1>&);
extern template std::vector<double> restated(const Model<2>&, std::span<const double>,
                                             const Model<2>&);
extern template std::vector<double> restated(const Model<3>&, std::span<const double>,
                                             const Model<3>&);

}  // namespace spam

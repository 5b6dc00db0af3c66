// SPDX-License-Identifier: GPL-3.0-or-later
// How fast viscosity and shifting act, before anything has moved.
#include "constitution.hpp"
#include "resting_body.hpp"
#include "shifting_coefficient.hpp"
#include <spam/core/error.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <fmt/format.h>

namespace spam {

/// Of the body at rest, at its mean density. By the artificial viscosity neighbours that move against
/// each other, v_ij = 2 v_i, lose their velocity at the rate (2/D) (alpha c l/rho) sum m |w'|/r in the
/// mean over directions, by half of the pairs: those that approach.
template <int Dim>
void SmoothParticles<Dim>::estimate_damping() {
    const GeneralWeight<Dim> general(scheme_.kernel, scheme_.range);
    const Matter matter = constitution_->matter(scheme_);
    const bool friction = matter == Matter::rubbing || sweeps_->gradient != nullptr;
    const bool shifted = scheme_.transport == Transport::shifting;
    if (!(scheme_.viscosity > 0.0) && !friction && !shifted) return;
    const RestingBody rest = resting_body(this->particles(), this->box(), general);
    damping_ = constitution_->damping(general, rest);
    const auto c = constitution_->sound_speed(rest.density);
    if (shifted) {
        shifting_ = shifting_coefficient(this->among(), scheme_, rest.density, c);
        damping_ += shifting_ * fastest_diffusion<Dim>(general);
    }
    if (!(scheme_.viscosity > 0.0)) return;
    if (!c)
        throw InputError(fmt::format(
            "viscosity: {} needs a sound speed, and the material ({}) has none; give it a "
            "sound_speed(density), or leave --viscosity out",
            scheme_.viscosity, constitution_->describe()));
    const double length = 0.5 * scheme_.range;
    damping_ += scheme_.viscosity * *c * length / Dim * rest.slope / rest.density;
    viscosity_ = {scheme_.viscosity, *c, length};
}

template void SmoothParticles<1>::estimate_damping();
template void SmoothParticles<2>::estimate_damping();
template void SmoothParticles<3>::estimate_damping();

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// How fast friction, conduction and shifting act in a state.
#include "constitution.hpp"
#include "resting_body.hpp"
#include "shifting_coefficient.hpp"
#include <spam/core/error.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

/// Once: the artificial viscosity's constants, the coefficient of shifting, and the body at rest, at its mean
/// density, that what is damped is judged by.
template <int Dim>
void SmoothParticles<Dim>::prepare_damping() {
    const bool shifted = scheme_.transport == Transport::shifting;
    if (!(scheme_.viscosity > 0.0) && !constitution_->diffuses() && !shifted) return;
    const GeneralWeight<Dim> weight(scheme_.kernel, scheme_.range);
    rest_ =
        std::make_unique<const RestingBody>(resting_body(this->particles(), this->box(), weight));
    const auto c = constitution_->sound_speed(rest_->density);
    if (shifted) shifting_ = shifting_coefficient(this->among(), scheme_, rest_->density, c);
    if (!(scheme_.viscosity > 0.0)) return;
    if (!c)
        throw InputError(fmt::format(
            "viscosity: {} needs a sound speed, and the material ({}) has none; give it a "
            "sound_speed(density), or leave --viscosity out",
            scheme_.viscosity, constitution_->describe()));
    viscosity_ = {scheme_.viscosity, *c, 0.5 * scheme_.range};
}

/// By the artificial viscosity neighbours that move against each other, v_ij = 2 v_i, lose their velocity
/// at the rate (2/D) (alpha c l/rho) sum m |w'|/r in the mean over directions, by half of the pairs: those
/// that approach.
template <int Dim>
double SmoothParticles<Dim>::fastest_damping_in(std::span<const double> y) const {
    if (!rest_) return 0.0;
    const GeneralWeight<Dim> weight(scheme_.kernel, scheme_.range);
    const std::size_t n = this->particles().size();
    std::vector<double> rho(n, rest_->density), e(n, 0.0);
    if (!y.empty()) {
        const auto energy = this->state_of(y).energy();
        rho = this->densities(y);
        e.assign(energy.data(), energy.data() + n);
    }
    double damping = constitution_->damping(weight, *rest_, rho, e);
    if (shifting_ > 0.0) damping += shifting_ * fastest_diffusion<Dim>(weight);
    if (viscosity_.alpha > 0.0)
        damping += viscosity_.alpha * constitution_->fastest_sound(*rest_, rho, e) *
                   viscosity_.length / Dim * rest_->slope / rest_->density;
    return damping;
}

template <int Dim>
double FluidConstitution<Dim>::fastest_sound(const RestingBody&, std::span<const double> rho,
                                             std::span<const double> e) const {
    double fastest = 0.0;
    for (std::size_t i = 0; i < rho.size(); ++i)
        fastest = std::max(fastest, of(i).state.sound_speed(rho[i], e[i]));
    return fastest;
}

/// By the shortest waves felt: momentum diffuses at (2 eta + lambda) k^2/rho or eta k^2/rho, heat at
/// kappa k^2/(rho c_v). By pairs neighbours that move against each other are stopped: at twice the sum of F
/// over them, of volumes as in the body at rest. Each with its own density: of several fluids the thin one is the
/// fastest. Two particles of different fluids approach each other at the rate c_ij (1/rho_i + 1/rho_j), with the
/// harmonic mean c_ij a mean of 2 c_i/rho_i and 2 c_j/rho_j: never faster than the faster of the two fluids.
template <int Dim>
double FluidConstitution<Dim>::damping(const GeneralWeight<Dim>& weight, const RestingBody& rest,
                                       std::span<const double> rho,
                                       std::span<const double> e) const {
    const double k = steepest_wave<Dim>(weight);
    double diffusion = 0.0, of_pairs = 0.0;
    for (std::size_t i = 0; i < rho.size(); ++i) {
        const Fluid& fluid = of(i);
        if (fluid.by_pairs) {
            of_pairs = std::max(of_pairs, pair_damping(fluid, Dim, rho[i], e[i]) / rho[i]);
            continue;
        }
        if (const auto& newton = fluid.viscosity)
            diffusion = std::max(
                diffusion, std::max(newton->eta, 2.0 * newton->eta + newton->lambda) / rho[i]);
        if (fluid.conduction)
            diffusion = std::max(diffusion, fluid.conduction->kappa /
                                                (rho[i] * fluid.state.heat_capacity(rho[i], e[i])));
    }
    return diffusion * k * k + 2.0 * of_pairs * rest.slope / rest.density;
}

#define SPAM_INSTANTIATE(D)                                                                    \
    template void SmoothParticles<D>::prepare_damping();                                       \
    template double SmoothParticles<D>::fastest_damping_in(std::span<const double>) const;     \
    template double FluidConstitution<D>::fastest_sound(                                       \
        const RestingBody&, std::span<const double>, std::span<const double>) const;           \
    template double FluidConstitution<D>::damping(const GeneralWeight<D>&, const RestingBody&, \
                                                  std::span<const double>,                     \
                                                  std::span<const double>) const;
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

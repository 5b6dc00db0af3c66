// SPDX-License-Identifier: GPL-3.0-or-later
#include "../smooth_particles/resting_body.hpp"
#include "../sweeps/packed_particles.hpp"
#include "../sweeps/term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/rhs/artificial_viscosity.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {
namespace {

template <int Dim>
PairLaw<Dim> viscous_law(const Selection<Dim>& among,
                         const typename ArtificialViscosity<Dim>::Constants& c) {
    for (const auto& [name, value] :
         {std::pair{"alpha", c.alpha}, {"density", c.density}, {"sound_speed", c.sound_speed}})
        if (!(value > 0.0) || !std::isfinite(value))
            throw InputError(
                fmt::format("viscosity: {} {:g} must be a positive number", name, value));
    const Particles<Dim>& particles = among.particles();
    PairLaw<Dim> law{best_sweeps([](auto level) { return viscous_sweeps<Dim, level>(); }),
                     valid_range<Dim>(c.range, particles.spacing, particles.size()),
                     fmt::format("artificial viscosity {:g} of range {:g}, sound speed {:.6g}",
                                 c.alpha, c.range, c.sound_speed)};
    law.constants.viscosity = {c.alpha, c.sound_speed, 0.5 * c.range};
    law.columns.emplace_back(particles.size(), c.density);
    law.kernel = c.kernel;
    law.heat = field_kind::viscous_heat;
    // As that of smooth particles (SmoothParticles::fastest_damping_in).
    const RestingBody rest =
        resting_body(particles, among.model().box(), GeneralWeight<Dim>(c.kernel, c.range));
    law.damping = c.alpha * c.sound_speed * 0.5 * c.range / Dim * rest.slope / c.density;
    return law;
}

}  // namespace

template <int Dim>
ArtificialViscosity<Dim>::ArtificialViscosity(const Selection<Dim>& among,
                                              const Constants& constants)
    : PairTerm<Dim>(among, viscous_law<Dim>(among, constants)) {}

SPAM_COMPILED(template class ArtificialViscosity);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// Laws that sum densities are refused where particles are corners of elements that hold a fluid.
#pragma once

#include <spam/core/error.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/elements.hpp>
#include <spam/rhs/ellipses.hpp>
#include <spam/rhs/own_ranges.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <fmt/format.h>

namespace spam {

template <class... Laws, int Dim>
bool is_one_of(const Term<Dim>& term) {
    return ((dynamic_cast<const Laws*>(&term) != nullptr) || ...);
}

/// The density of a fluid of elements is mass by area of each; its nodes have none.
template <int Dim>
void refuse_sums_over_nodes(const Term<Dim>& law, const Term<Dim>& mesh) {
    if constexpr (Dim == 2) {
        const auto* const elements = dynamic_cast<const Elements*>(&mesh);
        if (elements == nullptr || !elements->has_fluid() ||
            !is_one_of<SmoothParticles<2>, OwnRanges<2>, Ellipses<2>, DensityPotentialTerm<2>>(law))
            return;
        throw InputError(fmt::format(
            "model: '{}' sums densities over particles, and corners of elements that hold a fluid have none; leave "
            "it out, let it act among other particles, or use a fluid of smooth particles",
            law.nature().description));
    }
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of material that combinations.hpp has not, each with what holds it; compiled once (more_law_tables.hpp).
#pragma once

#include "rhs/combinations.hpp"

namespace spam::test {

/// A law of a solid or of a fluid, held by smooth particles.
template <int Dim, class MakeLaw>
Build<Dim> solid_of(const MakeLaw& make) {
    return [make](Sample<Dim>& s, const Scheme& scheme) {
        add_term<SmoothParticles<Dim>>(s, make(s), scheme);
    };
}
template <int Dim, class MakeLaw>
Build<Dim> fluid_of(const MakeLaw& make) {
    return [make](Sample<Dim>& s, const Scheme& scheme) { add_fluid(s, {make(s)}, scheme); };
}

template <int Dim>
const Laws<Dim>& more_laws();
extern const Laws<2> more_plane_laws;

/// Every law there is, by name.
template <int Dim>
Laws<Dim> every_law() {
    return merged(all_laws<Dim>(), more_laws<Dim>(), more_plane_laws);
}

}  // namespace spam::test

// SPDX-License-Identifier: GPL-3.0-or-later
// The laws of material that combinations.hpp has not, each with what holds it; compiled once (more_law_tables.hpp).
#pragma once

#include "rhs/combinations.hpp"

namespace spam::test {

template <int Dim>
extern const Laws<Dim> more_laws;
extern const Laws<2> more_plane_laws;

/// Every law there is, by name.
template <int Dim>
Laws<Dim> every_law() {
    return merged(all_laws<Dim>(), more_laws<Dim>, more_plane_laws);
}

}  // namespace spam::test

// SPDX-License-Identifier: GPL-3.0-or-later
// What is 1 in the problems whose numbers have no units.
#pragma once

#include <spam/core/unit_names.hpp>

namespace spam {

/// lambda = eta = sqrt(3/16), as of a triangular lattice of springs kappa = 1.
inline UnitNames lattice_units() {
    return reduced_units(
        "the mass of a particle, the spacing and the spring constant of their triangular lattice");
}

inline UnitNames fluid_units() {
    return reduced_units(
        "the mass of a particle, the spacing and the bulk modulus of the fluid at rest");
}

/// A temperature of one is 1 in energy by particle: k = 1.
inline UnitNames gas_units() {
    return reduced_units("the mass of a particle, the spacing and the energy k T of temperature 1");
}

}  // namespace spam

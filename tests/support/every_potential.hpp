// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/embedded_atom.hpp>
#include <spam/rhs/density_potentials.hpp>

namespace spam::test {

/// A potential of the density, of its gradient and its curvature, and a core.
inline DensityPotentials every_potential() {
    DensityPotentials everything{.surface_tension = 0.3,
                                 .strength = 0.2,
                                 .core = {0.7, 0.8},
                                 .kernel = Kernel::w5,
                                 .range = 2.8};
    everything.state = EmbeddedAtom{1.3, 0.9};
    return everything;
}

}  // namespace spam::test

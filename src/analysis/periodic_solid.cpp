// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/analysis/lattice_modes.hpp>
#include <spam/analysis/periodic_solid.hpp>
#include <spam/core/error.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {

PeriodicSolid triangular_solid(int columns, int rows, const Material<2>& material,
                               const Scheme& scheme, double density, double stress) {
    if (!(scheme.range <= 1e4))
        throw InputError(fmt::format("range: {} must not be above 10000 spacings; 2 to 4 are usual",
                                     scheme.range));
    const Box<2> box = triangular_box(columns, rows);
    if (std::min(box.length(0), box.length(1)) <= 2.0 * scheme.range) {
        const int least = static_cast<int>(2.0 * scheme.range / std::sqrt(0.75)) + 1;
        throw InputError(fmt::format(
            "cells: {} x {} particles are too few for --range {}: a periodic lattice is "
            "wider than twice the range; the least is {}",
            columns, rows, scheme.range, least + least % 2));
    }
    PeriodicSolid solid;
    solid.model = std::make_unique<SmoothParticleModel<2>>(
        make_particles<2>(triangular_block(columns, rows), 1.0, 1.0, box), material, scheme, box);
    solid.y0 = initial_state<2>(*solid.model, density, std::sqrt(3.0 / 16.0), at_rest<2>());
    State<2>(solid.model->layout(), solid.y0).stress().topRows<2>().setConstant(stress);
    return solid;
}

PeriodicSolid smallest_triangular_solid(const Material<2>& material, const Scheme& scheme,
                                        double density, double stress) {
    if (!(scheme.range <= 30.0))
        throw InputError(
            fmt::format("range: {} must not be above 30 spacings: the lattice analysed is as wide "
                        "as all that a particle feels; 2 to 4 are usual",
                        scheme.range));
    const int cells = static_cast<int>(2.0 * coupling_reach(scheme) / std::sqrt(0.75)) + 1;
    const int even = std::max(4, cells + cells % 2);
    return triangular_solid(even, even, material, scheme, density, stress);
}

}  // namespace spam

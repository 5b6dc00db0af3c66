// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/random_state.hpp"
#include <spam/rhs/smooth_particles.hpp>

#include <random>
#include <vector>

namespace spam::test {

/// Random velocities and, where the law has any, temperatures between 0.5 and 1.5.
template <int Dim>
std::vector<double> random_fluid(FluidModel<Dim>& model, unsigned seed) {
    auto y = random_state(model, seed);
    std::mt19937_64 random(seed + 1);
    std::uniform_real_distribution<double> T(0.5, 1.5);
    const auto rho = model.density(y);
    const State<Dim> state(model.layout(), y);
    for (std::size_t i = 0; i < rho.size(); ++i)
        state.energy()(0, static_cast<Eigen::Index>(i)) =
            model.fluid().state.starting_energy(rho[i], T(random));
    return y;
}

}  // namespace spam::test

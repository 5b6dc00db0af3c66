// SPDX-License-Identifier: GPL-3.0-or-later
// The gas whose particles tests of rezoning split and merge.
#pragma once

#include <spam/material/gamma_gas.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <memory>

namespace spam::test {

inline const Scheme summed{.density = Density::summed, .kernel = Kernel::w4, .range = 3.0};

template <int Dim>
std::shared_ptr<Model<Dim>> gas_of(Particles<Dim> particles) {
    return std::make_shared<FluidModel<Dim>>(std::move(particles), Fluid{GammaGas{2.0}}, summed);
}

}  // namespace spam::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/material/flow_stress.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

/// Y(eps_p) = Y + H eps_p; ideal plasticity with H = 0.
struct LinearHardening {
    static constexpr bool rate_dependent = false, thermal = false, linear = true;
    double Y;        ///< first yield
    double H = 0.0;  ///< hardening modulus

    double yield_stress(const FlowState& state) const { return Y + H * state.plastic_strain; }
    double work(double from, double d) const { return d * (Y + H * (from + 0.5 * d)); }
    std::string describe() const {
        return H == 0.0 ? fmt::format("Y = {:.6g}", Y)
                        : fmt::format("Y = {:.6g} + {:.6g} eps_p", Y, H);
    }
    /// Throws InputError.
    void validate() const {
        if (!(Y > 0.0) || !std::isfinite(Y))
            throw InputError(fmt::format("yield-stress: {:g} must be above 0", Y));
        if (!(H >= 0.0) || !std::isfinite(H))
            throw InputError(fmt::format(
                "hardening: {:g} must not be below 0; a solid that softens tears along single rows "
                "of particles, whatever their spacing",
                H));
    }
};

static_assert(FlowStress<LinearHardening>);

}  // namespace spam

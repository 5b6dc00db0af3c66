// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/linear_hardening.hpp>

namespace spam {

/// Perzyna's viscoplastic solid: the excess of the stress over the yield stress drives the flow,
///     q - Y(eps_p) = modulus tau d eps_p/dt,
/// modulus = 4 eta in the plane, 3 eta in space: an excess at fixed strain decays with the time tau.
struct Perzyna {
    static constexpr bool rate_dependent = true, thermal = false, linear = true;
    LinearHardening at_rest;
    double tau;  ///< relaxation time

    double yield_stress(const FlowState& state) const {
        return at_rest.yield_stress(state) + state.modulus * tau * state.rate;
    }
    double work(double from, double d) const { return at_rest.work(from, d); }
    std::string describe() const {
        return fmt::format("{}, relaxation time {:.6g}", at_rest.describe(), tau);
    }
    /// Throws InputError.
    void validate() const {
        at_rest.validate();
        if (!(tau > 0.0) || !std::isfinite(tau))
            throw InputError(fmt::format("relaxation-time: {:g} must be above 0", tau));
    }
};

static_assert(FlowStress<Perzyna>);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/error.hpp>
#include <spam/material/flow_stress.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {

/// Johnson and Cook (1983), for metals at high rates:
///     Y = (A + B eps_p^n) (1 + C ln(rate/rate_0)) (1 - T*^m),  T* = (T - T_room)/(T_melt - T_room),
/// no slower than rate_0, and T* between 0 and 1: what has melted does not resist.
struct JohnsonCook {
    static constexpr bool rate_dependent = true, thermal = true, linear = false;
    double A, B, n;
    double C = 0.0, rate_0 = 1.0;
    double m = 1.0, T_room = 0.0, T_melt = 1.0;
    double heat_capacity = 1.0;  ///< c_v, per mass: T - T_room = (e - elastic energy)/c_v
    double density = 1.0;        ///< of the solid at rest, to tell the elastic energy by mass

    double yield_stress(const FlowState& state) const {
        const double hot = std::clamp((state.temperature - T_room) / (T_melt - T_room), 0.0, 1.0);
        const double fast = state.rate > rate_0 ? C * std::log(state.rate / rate_0) : 0.0;
        return (A + B * std::pow(state.plastic_strain, n)) * (1.0 + fast) *
               (hot > 0.0 ? 1.0 - std::pow(hot, m) : 1.0);
    }
    /// Cold and slow.
    double work(double from, double d) const {
        const double k = n + 1.0;
        return A * d + B * (std::pow(from + d, k) - std::pow(from, k)) / k;
    }
    std::string describe() const {
        return fmt::format(
            "Johnson-Cook A = {:.6g}, B = {:.6g}, n = {:.6g}, C = {:.6g}, rate_0 = {:.6g}, m = "
            "{:.6g}",
            A, B, n, C, rate_0, m);
    }
    /// Throws InputError.
    void validate() const {
        if (!(A > 0.0) || !(B >= 0.0) || !(n > 0.0) || !(C >= 0.0) || !(rate_0 > 0.0) || !(m > 0.0))
            throw InputError(fmt::format(
                "johnson-cook: {} must have A, n, rate_0 and m above 0 and B and C not below 0",
                describe()));
        if (!(T_melt > T_room) || !(heat_capacity > 0.0) || !(density > 0.0))
            throw InputError(fmt::format(
                "johnson-cook: it must melt at a temperature ({:g}) above the room's ({:g}), and heat "
                "capacity ({:g}) and density ({:g}) must be above 0",
                T_melt, T_room, heat_capacity, density));
    }
};

static_assert(FlowStress<JohnsonCook>);

}  // namespace spam

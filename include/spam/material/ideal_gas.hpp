// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>

#include <fmt/format.h>

namespace spam {

/// Structureless particles of mass m in D dimensions, k = 1, [HH07] 1:
///     P = (2/D) rho e,   e = D T/(2m),   c^2 = (1 + 2/D) P/rho,
///     s = (1/m) ln(T^(D/2)/rho)
/// P = rho e in the plane, [HH01]; on the line P = 2 rho e.
struct IdealGas {
    int dimensions = 2;
    double mass = 1.0;

    double pressure(double rho, double e) const {
        return only_where(rho > 0.0 && e >= 0.0, 2.0 / dimensions * rho * e);
    }
    double sound_speed_squared(double rho, double e) const {
        return (1.0 + 2.0 / dimensions) * pressure(rho, e) / rho;
    }
    double temperature(double rho, double e) const {
        return only_where(rho > 0.0 && e >= 0.0, 2.0 / dimensions * mass * e);
    }
    double energy(double rho, double T) const {
        return only_where(rho > 0.0 && T >= 0.0, 0.5 * dimensions * T / mass);
    }
    double heat_capacity(double, double) const { return 0.5 * dimensions / mass; }
    double entropy(double rho, double e) const {
        return (0.5 * dimensions * std::log(temperature(rho, e)) - std::log(rho)) / mass;
    }
    std::string describe() const {
        return fmt::format("ideal gas in {} dimensions, particle mass {:.6g}", dimensions, mass);
    }
};

static_assert(ThermalEquationOfState<IdealGas>);

}  // namespace spam

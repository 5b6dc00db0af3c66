// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>

#include <fmt/format.h>

namespace spam {

/// An isentrope of the ideal gas, a power of the density, [HH01]:
///     P = P0 (rho/rho0)^gamma,   e = P/((gamma - 1) rho),   c^2 = gamma P/rho.
/// gamma > 1; it is 1 + 2/D for a gas of structureless particles in D dimensions.
struct IsentropicGas {
    double P0 = 1.0;
    double rho0 = 1.0;
    double gamma = 2.0;

    double pressure(double rho, double /*e*/ = 0.0) const {
        return only_where(rho > 0.0, P0 * std::pow(rho / rho0, gamma));
    }
    double sound_speed_squared(double rho, double /*e*/ = 0.0) const {
        return gamma * pressure(rho) / rho;
    }
    double cold_energy(double rho) const { return pressure(rho) / ((gamma - 1.0) * rho); }
    std::string describe() const {
        return fmt::format("isentropic gas, P = {:.6g} (rho/{:.6g})^{:.6g}", P0, rho0, gamma);
    }
};

static_assert(ColdEquationOfState<IsentropicGas>);

}  // namespace spam

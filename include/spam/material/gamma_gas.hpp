// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

/// Perfect gas of any ratio of its heat capacities, in any dimension: P = (gamma - 1) rho e,
/// c^2 = gamma P/rho, T = (gamma - 1) e, s = ln(T^(1/(gamma - 1))/rho) (k = m = 1). IdealGas is that of particles
/// without structure, gamma = 1 + 2/D.
struct GammaGas {
    double gamma = 1.4;

    double pressure(double rho, double e) const {
        return only_where(rho > 0.0 && e >= 0.0, (gamma - 1.0) * rho * e);
    }
    double sound_speed_squared(double rho, double e) const {
        return gamma * pressure(rho, e) / rho;
    }
    double temperature(double rho, double e) const {
        return only_where(rho > 0.0 && e >= 0.0, (gamma - 1.0) * e);
    }
    double energy(double rho, double T) const {
        return only_where(rho > 0.0 && T >= 0.0, T / (gamma - 1.0));
    }
    double heat_capacity(double, double) const { return 1.0 / (gamma - 1.0); }
    double entropy(double rho, double e) const {
        return std::log(temperature(rho, e)) / (gamma - 1.0) - std::log(rho);
    }
    std::string describe() const { return fmt::format("perfect gas, gamma = {:.6g}", gamma); }
};

static_assert(ThermalEquationOfState<GammaGas>);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>

#include <fmt/format.h>

namespace spam {

/// Van der Waals' fluid of particles of mass 1 in D dimensions, k = 1, [HH07] 1:
///     P = rho T/(1 - b rho) - a rho^2,   e = D T/2 - a rho,
///     c^2 = (1 + 2/D) T/(1 - b rho)^2 - 2 a rho,   s = ln((1 - b rho) T^(D/2)/rho)
/// for 0 < rho < 1/b. Critical point rho = 1/(3b), T = 8a/(27b), P = a/(27 b^2). Liquid and vapour
/// part where dP/drho at constant T is negative; sound stops (c^2 < 0) later than that.
struct VanDerWaals {
    double a = 1.0;
    double b = 1.0;
    int dimensions = 2;

    double pressure(double rho, double e) const {
        return rho * temperature(rho, e) / (1.0 - b * rho) - a * rho * rho;
    }
    double sound_speed_squared(double rho, double e) const {
        const double room = 1.0 - b * rho;
        return (1.0 + 2.0 / dimensions) * temperature(rho, e) / (room * room) - 2.0 * a * rho;
    }
    double temperature(double rho, double e) const {
        const double T = 2.0 / dimensions * (e + a * rho);
        return only_where(inside(rho) && T >= 0.0, T);
    }
    double energy(double rho, double T) const {
        return only_where(inside(rho) && T >= 0.0, 0.5 * dimensions * T - a * rho);
    }
    double heat_capacity(double, double) const { return 0.5 * dimensions; }
    double entropy(double rho, double e) const {
        return 0.5 * dimensions * std::log(temperature(rho, e)) + std::log(1.0 / rho - b);
    }

    double critical_density() const { return 1.0 / (3.0 * b); }
    double critical_temperature() const { return 8.0 * a / (27.0 * b); }
    std::string describe() const {
        return fmt::format("van der Waals fluid in {} dimensions, a = {:.6g}, b = {:.6g}",
                           dimensions, a, b);
    }

  private:
    bool inside(double rho) const { return rho > 0.0 && b * rho < 1.0; }
};

static_assert(ThermalEquationOfState<VanDerWaals>);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/van_der_waals.hpp>

namespace spam {

/// Van der Waals' fluid held at one temperature, as a cold law: its free energy per mass (particles of mass 1, k = 1,
/// up to a function of T, here such that no logarithm has a unit) takes the place of the energy,
///     e = -T ln((1 - b rho)/(b rho)) - a rho,   P = rho^2 de/d rho = rho T/(1 - b rho) - a rho^2,
///     c^2 = dP/d rho = T/(1 - b rho)^2 - 2 a rho
/// for 0 < rho < 1/b; NaN elsewhere. Below the critical temperature c^2 < 0 between two densities (spinodal()), and
/// liquid and vapour part (coexistence()): analysis/coexistence.hpp.
struct VanDerWaalsIsotherm {
    double a = 1.0;
    double b = 1.0;
    double T = 0.25;

    double pressure(double rho, double /*e*/ = 0.0) const {
        return only_where(inside(rho), rho * T / (1.0 - b * rho) - a * rho * rho);
    }
    double sound_speed_squared(double rho, double /*e*/ = 0.0) const {
        const double room = 1.0 - b * rho;
        return only_where(inside(rho), T / (room * room) - 2.0 * a * rho);
    }
    double cold_energy(double rho) const {
        return only_where(inside(rho), T * std::log(b * rho / (1.0 - b * rho)) - a * rho);
    }

    /// The law with an energy equation whose temperature this is.
    VanDerWaals at_any_temperature(int dimensions = 2) const { return {a, b, dimensions}; }
    double critical_density() const { return at_any_temperature().critical_density(); }
    double critical_temperature() const { return at_any_temperature().critical_temperature(); }
    /// No fluid is as dense.
    double densest() const { return 1.0 / b; }
    std::string describe() const {
        return fmt::format("van der Waals isotherm, a = {:.6g}, b = {:.6g}, T = {:.6g}", a, b, T);
    }

  private:
    bool inside(double rho) const { return rho > 0.0 && b * rho < 1.0; }
};

static_assert(ColdEquationOfState<VanDerWaalsIsotherm>);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>

namespace spam {

/// The isentrope of the plane ideal gas with which smooth particles move like molecules of the pair
/// potential m^2 w, [HH01] eq 20: P/rho^2 is the same for all.
///     P = rho^2/2,   e = rho/2,   c^2 = rho
struct LucyGas {
    double pressure(double rho, double /*e*/ = 0.0) const {
        return only_where(rho > 0.0, 0.5 * rho * rho);
    }
    double sound_speed_squared(double rho, double /*e*/ = 0.0) const {
        return only_where(rho > 0.0, rho);
    }
    double cold_energy(double rho) const { return only_where(rho > 0.0, 0.5 * rho); }
    std::string describe() const { return "Lucy gas, P = rho^2/2"; }
};

static_assert(ColdEquationOfState<LucyGas>);

}  // namespace spam

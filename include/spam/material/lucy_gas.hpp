// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>

#include <fmt/format.h>

namespace spam {

/// The isentrope of the plane ideal gas with which smooth particles move like molecules of the pair
/// potential a m^2 w, [HH01] eq 20 (a = 1): P/rho^2 is the same for all.
///     P = a rho^2/2,   e = a rho/2,   c^2 = a rho
struct LucyGas {
    double a = 1.0;  ///< energy length^D by mass^2

    double pressure(double rho, double /*e*/ = 0.0) const {
        return only_where(rho > 0.0, 0.5 * a * rho * rho);
    }
    double sound_speed_squared(double rho, double /*e*/ = 0.0) const {
        return only_where(rho > 0.0, a * rho);
    }
    double cold_energy(double rho) const { return only_where(rho > 0.0, 0.5 * a * rho); }
    std::string describe() const {
        return a == 1.0 ? "Lucy gas, P = rho^2/2" : fmt::format("Lucy gas, P = {:.6g} rho^2/2", a);
    }
};

static_assert(ColdEquationOfState<LucyGas>);

}  // namespace spam

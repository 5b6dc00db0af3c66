// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

/// A fluid that tears: where the tension -P would exceed P_c it stays at P_c, [HH07] 11 (the slide has
/// the sign of pressure wrong). Sound does not travel there, c^2 = 0. What the fluid stores there is
/// the work done, not the cold energy of the law: the clamp has none, and no potential of the density
/// can be made of it.
template <EquationOfState Law>
struct Cavitating {
    Law law;
    double tension_limit;  ///< P_c >= 0

    double pressure(double rho, double e) const {
        return std::max(law.pressure(rho, e), -tension_limit);  // a NaN stays one
    }
    double sound_speed_squared(double rho, double e) const {
        return law.pressure(rho, e) < -tension_limit ? 0.0 : law.sound_speed_squared(rho, e);
    }
    double temperature(double rho, double e) const requires ThermalEquationOfState<Law> {
        return law.temperature(rho, e);
    }
    double energy(double rho, double T) const requires ThermalEquationOfState<Law> {
        return law.energy(rho, T);
    }
    std::string describe() const {
        return fmt::format("{}, tension at most {:.6g}", law.describe(), tension_limit);
    }
};

}  // namespace spam

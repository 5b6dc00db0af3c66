// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/embedded_atom.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spam {

/// A fluid that tears: where the tension -P would exceed P_c it stays at P_c, [HH07] 11 (the slide has
/// the sign of pressure wrong). Sound does not travel there, c^2 = 0. What the fluid stores there is
/// the work done, not the cold energy of the law (CavitatingEmbeddedAtom has one of its own).
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
    double heat_capacity(double rho, double e) const requires ThermalEquationOfState<Law> {
        return law.heat_capacity(rho, e);
    }
    std::string describe() const {
        return fmt::format("{}, tension at most {:.6g}", law.describe(), tension_limit);
    }
};

/// The same of embedded atoms, 0 <= P_c < 4 B0/27, as a cold law: P depends on the density alone, so that
/// the work at constant tension is an energy, P = rho^2 de/d rho:
///     rho_2 <= rho            e(rho) of the embedded atom
///     rho_1 <= rho < rho_2    e(rho_2) + P_c (1/rho - 1/rho_2)
///              rho < rho_1    the embedded atom again, but for a constant that makes e continuous
/// rho_1 < rho_2: where the tension of the embedded atom is P_c.
class CavitatingEmbeddedAtom {
  public:
    CavitatingEmbeddedAtom(const EmbeddedAtom& law, double tension_limit)
        : clamped_{law, tension_limit} {
        // x = rho/rho0: x^3 - x^2 + P_c/B0 = 0 has three real roots, one of them below zero.
        const double angle = std::acos(1.0 - 13.5 * tension_limit / law.B0);
        const auto root = [&](double turn) {
            return law.rho0 / 3.0 * (1.0 + 2.0 * std::cos((angle - turn) / 3.0));
        };
        high_ = root(0.0);
        low_ = std::max(0.0, root(2.0 * std::numbers::pi));
        below_ = low_ > 0.0 ? stretched(low_) - law.cold_energy(low_) : 0.0;
    }

    double pressure(double rho, double e = 0.0) const { return clamped_.pressure(rho, e); }
    double sound_speed_squared(double rho, double e = 0.0) const {
        return clamped_.sound_speed_squared(rho, e);
    }
    double cold_energy(double rho) const {
        if (rho > low_ && rho < high_) return stretched(rho);
        return clamped_.law.cold_energy(rho) + (rho <= low_ ? below_ : 0.0);
    }
    /// Between these densities the tension is at its limit.
    std::array<double, 2> limits() const { return {low_, high_}; }
    std::string describe() const { return clamped_.describe(); }

  private:
    double stretched(double rho) const {
        return clamped_.law.cold_energy(high_) + clamped_.tension_limit * (1.0 / rho - 1.0 / high_);
    }

    Cavitating<EmbeddedAtom> clamped_;
    double low_, high_, below_;
};

static_assert(ColdEquationOfState<CavitatingEmbeddedAtom>);

}  // namespace spam

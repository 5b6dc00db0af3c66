// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>

#include <fmt/format.h>

namespace spam {

/// The cold fluid of [HH07] 1 and 6, free of pressure at rho0, with bulk modulus B0 there:
///     P = B0 (rho^3/rho0^3 - rho^2/rho0^2),   e = (B0/(2 rho0)) (rho/rho0 - 1)^2,
///     c^2 = (B0/rho0) (3 rho^2/rho0^2 - 2 rho/rho0)
/// Unstable below 2/3 rho0, where the tension is largest, 4 B0/27. For particles on a lattice rho0
/// must be the density that they sum to at a site, not mass per volume.
struct EmbeddedAtom {
    double B0 = 1.0;
    double rho0 = 1.0;

    double pressure(double rho, double /*e*/ = 0.0) const {
        const double x = rho / rho0;
        return only_where(rho > 0.0, B0 * x * x * (x - 1.0));
    }
    double sound_speed_squared(double rho, double /*e*/ = 0.0) const {
        const double x = rho / rho0;
        return only_where(rho > 0.0, B0 / rho0 * x * (3.0 * x - 2.0));
    }
    double cold_energy(double rho) const {
        const double strain = rho / rho0 - 1.0;
        return only_where(rho > 0.0, 0.5 * B0 / rho0 * strain * strain);
    }
    std::string describe() const {
        return fmt::format("embedded atom, B0 = {:.6g}, rho0 = {:.6g}", B0, rho0);
    }
};

static_assert(ColdEquationOfState<EmbeddedAtom>);

}  // namespace spam

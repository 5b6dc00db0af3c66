// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spam {

/// Linear elasticity of a disk of radius R that turns with angular velocity omega, free at its rim,
/// lambda = eta, [HHM04] VI (rho: density of the undeformed disk; r: distance from the centre there):
///     u_r      = (rho r omega^2/eta) (5 R^2 - 2 r^2)/48
///     sigma_rr = (5 rho omega^2/12) (R^2 - r^2)
///     sigma_tt = (5 rho omega^2/12) (R^2 - 3 r^2/5)
/// The stresses are as printed. The displacement is not: (rho r omega^2/6) (R^2 - 2 r^2/3), with 1/eta
/// or without, neither has these stresses nor leaves the rim free (tests/diagnostics/rotating_disk).
struct RotatingDisk {
    double rho, eta, omega, R;

    double load() const { return rho * omega * omega; }
    double displacement(double r) const {
        return load() * r * (5.0 * R * R - 2.0 * r * r) / (48.0 * eta);
    }
    double radial_stress(double r) const { return 5.0 / 12.0 * load() * (R * R - r * r); }
    double hoop_stress(double r) const { return 5.0 / 12.0 * load() * (R * R - 0.6 * r * r); }
    double shear_stress(double) const { return 0.0; }
    /// sigma_rr = sigma_tt there.
    double centre_stress() const { return radial_stress(0.0); }
    /// rho (1 - div u)
    double density(double r) const {
        return rho * (1.0 - load() * (10.0 * R * R - 8.0 * r * r) / (48.0 * eta));
    }
};

}  // namespace spam

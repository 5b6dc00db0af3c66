// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace cantilever {

/// A plate held at x = 0, free at x = L, or free at both ends, in plane strain, as theories of beams see it.
struct Beam {
    double length = 0.2, thickness = 0.02;
    double young = 2e6, poisson = 0.3975;
    double density = 1000.0;

    /// E/(1 - nu^2): plane strain has no room sideways.
    double modulus() const { return young / (1.0 - poisson * poisson); }
    double shear_modulus() const { return 0.5 * young / (1.0 + poisson); }
    double bulk_modulus() const { return young / (3.0 * (1.0 - 2.0 * poisson)); }
    /// The first Lame constant.
    double lambda() const { return young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
    /// The fastest wave of an infinite body, sqrt((lambda + 2 eta)/rho).
    double wave_speed() const;

    /// Of the first mode of a thin beam, from cos kL cosh kL = -1:
    ///     omega^2 = E H^2 k^4/(12 rho (1 - nu^2)),   Landau & Lifshitz, Theory of Elasticity, 25.
    double thin_period() const;
    /// The same with shear and rotary inertia, shear coefficient 5/6: the root of the frequency equation
    /// of Timoshenko's beam, clamped and free (Huang 1961). Throws std::domain_error where the first mode is no
    /// bending any more, for plates about as thick as long.
    double period() const;
    /// The shape of the thin beam's first mode, f(x)/f(L); 0 for x < 0.
    double shape(double x) const;

    /// The first period with both ends free, shear and rotary inertia: from the frequency equation of
    /// Timoshenko's beam, free and free (Huang 1961). Throws as period() does.
    double free_period() const;
    /// The shape of a thin beam's first mode with both ends free, 1 at the ends, x from its middle; and its
    /// slope.
    double free_shape(double x) const;
    double free_slope(double x) const;
};

/// What `layers` rows of a square lattice of total-Lagrangian particles make of that period, with Lucy's
/// weight function of `range` spacings. Derived: rows carry the bending strain kappa y_k where they lie, so
/// that the second moment of n rows is 1/n^2 short. Near the faces they carry less, because a gradient that
/// is exact for linear fields takes that of x y from the mean place of the neighbours,
///     e_k = y_k + sum_j q a^2 b/sum_j q a^2,   q = -w'/r, (a, b) = X_j - X_i;
/// the stiffness is E' sum_k e_k^2 times the spacing. And the last particles that are held lie half a
/// spacing before x = 0, from where the plate is free to bend:
///     T_n = T (1 + H/(2 n L))^2/sqrt(12 sum_k e_k^2/(n H^2))
double layered_period(const Beam& beam, int layers, double range);

/// The limit of a + b/n + c/n^2 for large n, through three points n, 2n, 4n.
double limit_of_doubling(double of_n, double of_2n, double of_4n);

}  // namespace cantilever

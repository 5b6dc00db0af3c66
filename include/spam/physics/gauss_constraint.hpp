// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

/// Gauss' principle of least constraint, [HHM04] VII (the printed multipliers lack a sign and mix
/// masses): of all constraint forces that keep a body's angular momentum and energy the smallest are
///     F_i = m_i (-alpha (v_i - V) + beta z x (r_i - X)),
///     beta = -L_dot / (I - L^2/2K),   alpha = beta L / 2K,
/// about the body's centre of mass X and its velocity V, so that momentum is kept as well and nothing depends
/// on the frame: I = sum m r^2, L = sum m r x v, K = sum m v^2/2 and L_dot, the rate without the constraint,
/// are those of r - X and v - V; X moves with the mean of what moves particles. The
/// denominator is I times the share of K that is not rigid rotation: what the rotation is to get is
/// taken from there. It is zero in a rigid rotation, and nearly so again and again.
namespace spam {

struct GaussMultipliers {
    double alpha = 0.0, beta = 0.0;
    double health = 1.0;    ///< (I - L^2/2K)/I, from 0 to 1
    bool singular = false;  ///< the constraint is off
};

/// `twice_K` = sum m v^2. Called singular, and left off, is a constraint that would use up the rest of
/// K before the body has turned by half a radian, |alpha| > |L|/I: soon after no finite one exists,
/// and while it diverges no integrator keeps the energy.
inline GaussMultipliers gauss_multipliers(double I, double L, double twice_K, double L_dot) {
    GaussMultipliers m;
    if (!(I > 0.0) || !(twice_K > 0.0)) return m;  // nothing moves, nothing to keep
    m.health = 1.0 - L * L / (twice_K * I);
    m.beta = -L_dot / (I * m.health);
    m.alpha = m.beta * L / twice_K;
    m.singular = !(m.health > 0.0) || !(std::abs(m.alpha) * I <= std::abs(L));
    if (m.singular) m.alpha = m.beta = 0.0;
    return m;
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/any_weight.hpp>

namespace spam {

/// How heat and momentum diffuse through a square lattice of smooth particles (spacing and masses of
/// one) at the wave number k along an axis, exactly, for small amplitudes. A gradient sum makes a sine
/// into a cosine, times k times the filter c/rho_s, and diffusion is two of them:
///     c = (1/k) sum_j (-w'(r)/r) x sin kx,      rho_s = sum_j w(r_j),
///     heat      decays at  kappa k^2 factor/c_v,  factor = c^2/rho_s^3    (particles held in place)
///     momentum  is damped at  gamma = eta k^2 factor   (a transverse wave)
/// factor -> 1 as k -> 0 but for the lattice's rest; 1 - factor is of second order in h k. Sheared, a lattice
/// under the pressure P is besides not quite a fluid: sums over w_xx, whose integral vanishes, leave
///     -P spring u,   spring = (2/rho_s^2) sum_j w_xx(r) (1 - cos ky),
/// on a displacement u, and a shear wave is a damped oscillator, v'' + gamma v' + P spring v = 0, as
/// long as it displaces particles by much less than their spacing.
struct SquareLatticeDiffusion {
    double site_density;  ///< rho_s
    double factor;
    double spring;  ///< by P; of either sign

    /// Precondition: k > 0.
    SquareLatticeDiffusion(const AnyWeight<2>& weight, double k);

    /// v(t)/v(0) of a shear wave in a fluid of pressure P and viscosity eta.
    double shear_wave(double t, double k, double eta, double P) const;
};

}  // namespace spam

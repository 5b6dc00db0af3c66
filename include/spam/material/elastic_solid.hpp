// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/stress_law.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

/// Isotropic linear elasticity with co-rotation, [HHM04] II:
///     sigma_dot = lambda (div v) I + eta (grad v + grad v^t) + W sigma - sigma W,
///     W_ab = (d v_a/d x_b - d v_b/d x_a)/2.
/// In the plane, with omega = (d v_y/dx - d v_x/dy)/2, the rotation adds -2 omega sigma_xy to xx,
/// +2 omega sigma_xy to yy, omega (sigma_xx - sigma_yy) to xy. Plane bodies: no zz component.
/// In one dimension it is the bar, sigma_dot = (lambda + 2 eta) dv/dx.
struct ElasticSolid {
    double lambda;  ///< first Lame constant
    double eta;     ///< second Lame constant (shear modulus)

    /// The constants of the triangular lattice of nearest-neighbour springs kappa, [HHM04] V.
    static ElasticSolid triangular_lattice(double kappa = 1.0) {
        const double modulus = std::sqrt(3.0 / 16.0) * kappa;
        return {modulus, modulus};
    }

    /// c_L
    double sound_speed(double density) const { return std::sqrt((lambda + 2.0 * eta) / density); }

    /// One line with both constants.
    std::string describe() const {
        return fmt::format("elastic solid, lambda = {:.6g}, eta = {:.6g}", lambda, eta);
    }

    /// sigma_dot (stress/time) for (grad v)_ab = d v_b/d x_a and the stress, tension positive. T is double or Lanes.
    template <int Dim, class T>
    SymTensor<Dim, T> stress_rate(const Mat<Dim, T>& grad_v,
                                  const SymTensor<Dim, T>& stress) const {
        const T dilation = lambda * grad_v.trace();
        SymTensor<Dim, T> rate;
        for (int a = 0; a < Dim; ++a) rate(a, a) = dilation + 2.0 * eta * grad_v(a, a);
#pragma GCC unroll 3
        for (int a = 0; a < Dim; ++a)
#pragma GCC unroll 3
            for (int b = a + 1; b < Dim; ++b) {
                rate(a, b) += eta * (grad_v(a, b) + grad_v(b, a));
                // W sigma - sigma W, from W_ab = -W_ba: each touches row and column a and b.
                const T W = 0.5 * (grad_v(b, a) - grad_v(a, b));
                rate(a, a) += 2.0 * W * stress(a, b);
                rate(b, b) -= 2.0 * W * stress(a, b);
                rate(a, b) += W * (stress(b, b) - stress(a, a));
#pragma GCC unroll 3
                for (int c = 0; c < Dim; ++c) {
                    if (c == a || c == b) continue;
                    rate(a, c) += W * stress(b, c);
                    rate(b, c) -= W * stress(a, c);
                }
            }
        return rate;
    }
};

static_assert(StressLaw<ElasticSolid, 1> && StressLaw<ElasticSolid, 2> &&
              StressLaw<ElasticSolid, 3>);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/density_potential.hpp>

namespace spam {

/// An energy of density gradients, which are large where matter ends: surface tension, [HH07] 8.
///     Phi = s_g sum_i |g_i|^2,   g = grad rho = sum_j m_j grad w,
///     F_i = -2 s_g sum_j (grad grad w_ij) . (m_j g_i - m_i g_j)
/// No even lattice has it, strained or not: it gives no shear modulus. Needs w_3 (Lucy) or smoother.
struct SurfaceTension {
    static constexpr const char* name = "gradient";
    static constexpr int density_derivatives = 1;
    static constexpr double parity = -1.0;
    template <int Dim, class T = double>
    using Field = Vec<Dim, T>;  ///< grad rho

    double s_g;

    template <int Dim, class T>
    static Vec<Dim, T> weigh(const WeightAt<Dim, T>& at) {
        return at.slope * at.n;
    }
    template <int Dim>
    double energy(double /*mass*/, const Vec<Dim>& g) const {
        return s_g * dot(g, g);
    }
    template <int Dim>
    Vec<Dim> slope(double /*mass*/, const Vec<Dim>& g) const {
        return (2.0 * s_g) * g;
    }
    /// G . grad grad w, with grad grad w = (w'/r) 1 + (w'' - w'/r) n n
    template <int Dim, class T>
    static Vec<Dim, T> pull(const Vec<Dim, T>& G, const WeightAt<Dim, T>& at) {
        return at.slope_over_r * G + ((at.second - at.slope_over_r) * dot(G, at.n)) * at.n;
    }
};

static_assert(DensityTerm<SurfaceTension, 1> && DensityTerm<SurfaceTension, 2> &&
              DensityTerm<SurfaceTension, 3>);

}  // namespace spam

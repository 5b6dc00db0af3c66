// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/density_potential.hpp>

namespace spam {

/// An energy of the density's uneven curvature, which shear of a lattice changes: strength, [HH07] 8.
/// In the plane, with the curvatures rho_xx, rho_yy, rho_xy,
///     Phi = s_c sum_i ((rho_xx - rho_yy)^2 + 4 rho_xy^2) = 2 s_c sum_i D_i : D_i,
/// D the part of grad grad rho without trace: so written it is the same potential in space (and always
/// zero on a line, where it is refused). With T_ij = grad_i grad_i grad_i w_ij,
///     F_i = -4 s_c sum_j (m_j D_i + m_i D_j) : T_ij,
///     D : T = 2 ((w'' - w'/r)/r) D . n + (w''' - 3 (w'' - w'/r)/r) (n . D . n) n.
/// Needs w_4 or smoother: with Lucy's or Monaghan's weight forces would jump.
struct CurvatureStrength {
    static constexpr const char* name = "curvature";
    static constexpr int density_derivatives = 2;
    static constexpr double parity = 1.0;
    static constexpr int least_dimension = 2;
    template <int Dim, class T = double>
    using Field = SymTensor<Dim, T>;  ///< D

    double s_c;

    template <int Dim, class T>
    static SymTensor<Dim, T> weigh(const WeightAt<Dim, T>& at) {
        const T c = at.second - at.slope_over_r;
        SymTensor<Dim, T> D;
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) D(a, b) = c * at.n[a] * at.n[b];
        const T third = T(1.0 / Dim) * c * dot(at.n, at.n);
        for (int a = 0; a < Dim; ++a) D(a, a) -= third;
        return D;
    }
    template <int Dim>
    double energy(double /*mass*/, const SymTensor<Dim>& D) const {
        double square = 0.0;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) square += D(a, b) * D(a, b);
        return 2.0 * s_c * square;
    }
    template <int Dim>
    SymTensor<Dim> slope(double /*mass*/, const SymTensor<Dim>& D) const {
        return (4.0 * s_c) * D;
    }
    template <int Dim, class T>
    static Vec<Dim, T> pull(const SymTensor<Dim, T>& G, const WeightAt<Dim, T>& at) {
        const Vec<Dim, T> along = G * at.n;
        const T c = at.second_over_r;
        return (T(2.0) * c) * along + ((at.third - T(3.0) * c) * dot(along, at.n)) * at.n;
    }
};

static_assert(DensityTerm<CurvatureStrength, 2> && DensityTerm<CurvatureStrength, 3>);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

#include <cmath>

namespace spam {

// A solid whose particles k remember, for each present neighbour j, a material vector X_kj. With r_kj = x_j - x_k
// and w = g(|X_kj|) s(r_kj) the deformation gradient is the least-squares fit of r = F X,
//     N_k = sum w X (x) X,   F_k = [sum w r (x) X] N_k^-1,   e_kj = r_kj - F_k X_kj,
// and the energy is Phi = sum_k th_k [V_k W(F_k) + (c_k/2) sum_j w |e_kj|^2]. It knows neither origin nor
// axes, whatever the tables hold: p and L are kept exactly. Written over an arithmetic type, once for
// double and once for lanes. Derived here; forces against -dPhi/dx in tests/rhs/material_vectors.cpp.

/// The part g(|X|) of the weight, fixed as long as X is: (1 - |X|/(reach h))^power inside reach h. Decided by
/// what has been, it weakens no bond because the body is stretched: no tensile instability. Chosen by
/// problems/material_vectors_study.cpp; one more steep bears more tension, and knows more of disorder.
struct MaterialWeight {
    double reach = 1.25, power = 4.0;

    double operator()(double length, double range) const {
        const double z = positive_part(1.0 - length / (reach * range));
        if (power == 4.0) return (z * z) * (z * z);
        return z > 0.0 ? std::pow(z, power) : 0.0;
    }
};

/// The part s(r) = z^2 (3 - 2z), z = (1 - r^2/h^2)/0.51 clipped to [0, 1], which lets neighbours come and go
/// between 0.7 h and h. Of r^2, so that no bond costs a root or a quotient.
template <class T>
struct BondFade {
    T s, slope;  ///< slope = s'(r)/r

    constexpr BondFade(const T& r2, double inverse_range) {
        const T free = T(1.0 / 0.51) - T(inverse_range * inverse_range / 0.51) * r2;
        const T z = T(1.0) - positive_part(T(1.0) - positive_part(free));
        s = z * z * (T(3.0) - T(2.0) * z);
        slope = T(-12.0 / 0.51 * inverse_range * inverse_range) * z * (T(1.0) - z);
    }
};

/// The sums of the fit, N and sum w r (x) X.
template <int Dim, class T>
struct BondFit {
    SymTensor<Dim, T> N;
    Mat<Dim, T> A;

    constexpr void add(const T& w, const Vec<Dim, T>& r, const Vec<Dim, T>& X) {
        const Vec<Dim, T> wX = w * X;
        add_outer(A, r, wX);
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) N(a, b) += wX[a] * X[b];
    }
};

/// What divides by N + little: Cholesky's L D L^t, which finds all that N says of directions that few neighbours
/// span. `little` is for those that none spans; what it does to Phi is below rounding.
template <int Dim, class T>
struct FitSolver {
    Mat<Dim, T> R;  ///< L^-1, unit lower triangle
    Vec<Dim, T> inverse_D;

    /// For particles that are whole with N0.
    static constexpr double little(double N0) { return 1e-13 * N0; }

    constexpr FitSolver(const SymTensor<Dim, T>& N, double little) {
        Mat<Dim, T> L;
        Vec<Dim, T> D;
        for (int a = 0; a < Dim; ++a) {
            D[a] = N(a, a) + T(little);
            for (int c = 0; c < a; ++c) D[a] -= L(a, c) * L(a, c) * D[c];
            inverse_D[a] = T(1.0) / D[a];
            for (int b = a + 1; b < Dim; ++b) {
                T l = N(a, b);
                for (int c = 0; c < a; ++c) l -= L(b, c) * L(a, c) * D[c];
                L(b, a) = l * inverse_D[a];
            }
        }
        for (int b = 0; b < Dim; ++b) {
            R(b, b) = T(1.0);
            for (int a = b + 1; a < Dim; ++a) {
                T sum{};
                for (int c = b; c < a; ++c) sum -= L(a, c) * R(c, b);
                R(a, b) = sum;
            }
        }
    }

    /// A (N + little)^-1 without the inverse, whose large numbers would leave their rounding in the directions
    /// that are spanned.
    constexpr Mat<Dim, T> divided(const Mat<Dim, T>& A) const {
        Mat<Dim, T> F;
        for (int row = 0; row < Dim; ++row)
            for (int b = 0; b < Dim; ++b) {
                T z = A(row, b);
                for (int c = 0; c < b; ++c) z += R(b, c) * A(row, c);
                z *= inverse_D[b];
                for (int c = 0; c <= b; ++c) F(row, c) += R(b, c) * z;
            }
        return F;
    }

    /// R^t D^-1 R
    constexpr SymTensor<Dim, T> inverse() const {
        SymTensor<Dim, T> K;
        for (int a = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b) {
                T sum{};
                for (int c = b; c < Dim; ++c) sum += R(c, a) * R(c, b) * inverse_D[c];
                K(a, b) = sum;
            }
        return K;
    }
};

/// How far the neighbours of a particle span space: th, a smoothstep of q/(0.1 N0), q = D/tr(N^-1) between
/// once and D times the smallest eigenvalue of N, and its derivative, dth = slope N^-2 : dN. 1 inside a
/// body and at its corners; a particle that has lost its neighbours bears no stress and has no
/// misfit: along a row of particles F across it follows any particle that is near with however little weight,
/// faster than any step.
struct Wholeness {
    double th, slope;

    /// The q/N0 above which F means something in every direction: th > 1e-6; its error is below 1e-8 then.
    static constexpr double spanning = 5.775e-5;
    bool spans() const { return th > 1e-6; }

    template <int Dim>
    static Wholeness of(const SymTensor<Dim>& inverse_N, double N0) {
        double trace = 0.0;
        for (int a = 0; a < Dim; ++a) trace += inverse_N(a, a);
        const double q = Dim / trace, z = q / (0.1 * N0);
        if (!(z > 0.0)) return {0.0, 0.0};
        if (z >= 1.0) return {1.0, 0.0};
        return {z * z * (3.0 - 2.0 * z), 6.0 * z * (1.0 - z) / (0.1 * N0) * q * q / Dim};
    }
};

/// t_kj = dE_k/dr_kj of one bond: with G_k = V th P N^-1, H_k = [V W + (c_k/2) sum w |e|^2] dth/dN and c = th c_k
///     w (G X + c e) + g s'/r r [e.G X + c |e|^2/2 + X.H X].
/// The change of F with w is there, N being fixed: dF = dw e (x) X N^-1; that of the misfit through F is
/// none, because F minimises it. The acceleration is m v_dot_i = sum_j (t_ij - t_ji).
template <int Dim, class T>
struct BondLaw {
    Mat<Dim, T> F, G;
    SymTensor<Dim, T> H;
    T c;

    /// `Whole`: H = 0.
    template <bool Whole>
    constexpr Vec<Dim, T> force(const T& g, const Vec<Dim, T>& r, const Vec<Dim, T>& X,
                                double inverse_range) const {
        const BondFade<T> fade(dot(r, r), inverse_range);
        Vec<Dim, T> e = r;
        e -= F * X;
        const Vec<Dim, T> GX = G * X;
        T change = dot(e, GX) + T(0.5) * c * dot(e, e);
        if constexpr (!Whole) change += dot(X, H * X);
        return (g * fade.s) * (GX + c * e) + (g * fade.slope * change) * r;
    }
};

}  // namespace spam

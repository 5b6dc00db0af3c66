// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>

#include <cmath>

namespace spam {

/// A = sum_a value[a] n_a n_a, the components of n_a in column a of `vectors`. The values in no order.
template <int Dim>
struct SymmetricEigen {
    Vec<Dim> value;
    Mat<Dim> vectors;
};

/// Turns the plane (p, q) so that A_pq vanishes. Returns whether it had not.
template <int Dim>
inline bool jacobi_rotation(SymTensor<Dim>& A, Mat<Dim>& V, int p, int q) {
    const double b = A(p, q);
    if (std::abs(b) <= 1e-17 * (std::abs(A(p, p)) + std::abs(A(q, q)))) return false;
    const double half = 0.5 * (A(q, q) - A(p, p));
    const double t = b / (half + std::copysign(std::sqrt(half * half + b * b), half));
    const double c = 1.0 / std::sqrt(1.0 + t * t), s = t * c;
    A(p, p) -= t * b;
    A(q, q) += t * b;
    A(p, q) = 0.0;
    for (int r = 0; r < Dim; ++r) {
        if (r != p && r != q) {
            const double at_p = A(r, p), at_q = A(r, q);
            A(r, p) = c * at_p - s * at_q;
            A(r, q) = s * at_p + c * at_q;
        }
        const double v_p = V(r, p), v_q = V(r, q);
        V(r, p) = c * v_p - s * v_q;
        V(r, q) = s * v_p + c * v_q;
    }
    return true;
}

/// By Jacobi's rotations: to rounding error, equal eigenvalues included, and in a fixed order of operations.
/// NaN where A has one.
template <int Dim>
inline SymmetricEigen<Dim> symmetric_eigen(SymTensor<Dim> A) {
    SymmetricEigen<Dim> e;
    for (int a = 0; a < Dim; ++a) e.vectors(a, a) = 1.0;
    bool turned = Dim > 1;
    for (int sweep = 0; turned && sweep < 12; ++sweep) {
        turned = false;
        for (int p = 0; p < Dim; ++p)
            for (int q = p + 1; q < Dim; ++q)
                turned = jacobi_rotation(A, e.vectors, p, q) || turned;
    }
    for (int a = 0; a < Dim; ++a) e.value[a] = A(a, a);
    return e;
}

/// n_a of the largest value, or of the least.
template <int Dim>
inline Vec<Dim> principal_axis(const SymmetricEigen<Dim>& e, bool of_largest) {
    int found = 0;
    for (int a = 1; a < Dim; ++a)
        if (of_largest ? e.value[a] > e.value[found] : e.value[a] < e.value[found]) found = a;
    Vec<Dim> n;
    for (int a = 0; a < Dim; ++a) n[a] = e.vectors(a, found);
    return n;
}

/// sum_a value[a] n_a n_a
template <int Dim>
inline SymTensor<Dim> from_eigen(const Vec<Dim>& value, const Mat<Dim>& vectors) {
    SymTensor<Dim> A;
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b)
            for (int k = 0; k < Dim; ++k) A(a, b) += value[k] * vectors(a, k) * vectors(b, k);
    return A;
}

}  // namespace spam

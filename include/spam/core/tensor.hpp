// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>

namespace spam {

/// General second-rank tensor, t(a, b), row a and column b.
template <int Dim, class T = double>
struct Mat {
    std::array<T, Dim * Dim> c{};

    constexpr T& operator()(int a, int b) { return c[static_cast<std::size_t>(a * Dim + b)]; }
    constexpr const T& operator()(int a, int b) const {
        return c[static_cast<std::size_t>(a * Dim + b)];
    }
    constexpr Mat& operator+=(const Mat& o) {
        for (std::size_t k = 0; k < c.size(); ++k) c[k] += o.c[k];
        return *this;
    }
    friend constexpr Mat operator+(Mat a, const Mat& b) { return a += b; }
    friend constexpr Mat operator*(const T& s, Mat a) {
        for (auto& x : a.c) x *= s;
        return a;
    }
    constexpr T trace() const {
        T s = (*this)(0, 0);
        for (int a = 1; a < Dim; ++a) s += (*this)(a, a);
        return s;
    }
};

/// Number of independent components of a symmetric tensor: 1, 3, 6.
constexpr int symmetric_size(int dim) { return dim * (dim + 1) / 2; }

/// Where component (a, b) of a symmetric tensor is stored: xx / xx yy xy / xx yy zz xy yz xz.
constexpr int symmetric_index(int dim, int a, int b) {
    if (a == b) return a;
    if (dim == 2) return 2;
    constexpr int off_diagonal[3] = {3, 5, 4};  // by a + b - 1: xy, xz, yz
    return off_diagonal[a + b - 1];
}

/// Symmetric second-rank tensor: stress, strain.
template <int Dim, class T = double>
struct SymTensor {
    static constexpr int size = symmetric_size(Dim);
    std::array<T, static_cast<std::size_t>(size)> c{};

    constexpr T& operator()(int a, int b) {
        return c[static_cast<std::size_t>(symmetric_index(Dim, a, b))];
    }
    constexpr const T& operator()(int a, int b) const {
        return c[static_cast<std::size_t>(symmetric_index(Dim, a, b))];
    }
    friend constexpr SymTensor operator+(SymTensor a, const SymTensor& b) {
        for (std::size_t k = 0; k < a.c.size(); ++k) a.c[k] += b.c[k];
        return a;
    }
    friend constexpr SymTensor operator*(const T& s, SymTensor a) {
        for (auto& x : a.c) x *= s;
        return a;
    }
};

/// (A S)_ab = A_ac S_cb
template <int Dim, class T>
constexpr Mat<Dim, T> operator*(const Mat<Dim, T>& m, const SymTensor<Dim, T>& s) {
    Mat<Dim, T> r;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) {
            r(a, b) = m(a, 0) * s(0, b);
            for (int c = 1; c < Dim; ++c) r(a, b) += m(a, c) * s(c, b);
        }
    return r;
}

/// (A . v)_a = A_ab v_b
template <int Dim, class T>
constexpr Vec<Dim, T> operator*(const Mat<Dim, T>& m, const Vec<Dim, T>& v) {
    Vec<Dim, T> r;
    for (int a = 0; a < Dim; ++a) {
        r[a] = m(a, 0) * v[0];
        for (int b = 1; b < Dim; ++b) r[a] += m(a, b) * v[b];
    }
    return r;
}

/// A_ab += u_a v_b
template <int Dim, class T>
constexpr void add_outer(Mat<Dim, T>& m, const Vec<Dim, T>& u, const Vec<Dim, T>& v) {
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) m(a, b) += u[a] * v[b];
}

/// (S . v)_a = S_ab v_b
template <int Dim, class T>
constexpr Vec<Dim, T> operator*(const SymTensor<Dim, T>& s, const Vec<Dim, T>& v) {
    Vec<Dim, T> r;
    for (int a = 0; a < Dim; ++a) {
        r[a] = s(a, 0) * v[0];
        for (int b = 1; b < Dim; ++b) r[a] += s(a, b) * v[b];
    }
    return r;
}

template <int Dim, class T>
constexpr T determinant(const Mat<Dim, T>& m) {
    if constexpr (Dim == 1)
        return m(0, 0);
    else if constexpr (Dim == 2)
        return m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
    else
        return m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
               m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
               m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
}

/// By cofactors; infinite or NaN where there is none.
template <int Dim, class T>
constexpr Mat<Dim, T> inverse(const Mat<Dim, T>& m) {
    const T scale = T(1.0) / determinant(m);
    Mat<Dim, T> r;
    if constexpr (Dim == 1) {
        r(0, 0) = scale;
    } else if constexpr (Dim == 2) {
        r(0, 0) = scale * m(1, 1);
        r(0, 1) = -scale * m(0, 1);
        r(1, 0) = -scale * m(1, 0);
        r(1, 1) = scale * m(0, 0);
    } else {
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) {
                const int i = (b + 1) % 3, j = (b + 2) % 3, k = (a + 1) % 3, l = (a + 2) % 3;
                r(a, b) = scale * (m(i, k) * m(j, l) - m(i, l) * m(j, k));
            }
    }
    return r;
}

/// (M S M^t)_ab = M_ac S_cd M_bd
template <int Dim, class T>
constexpr SymTensor<Dim, T> transformed(const Mat<Dim, T>& m, const SymTensor<Dim, T>& s) {
    const Mat<Dim, T> m_s = m * s;
    SymTensor<Dim, T> r;
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) {
            r(a, b) = m_s(a, 0) * m(b, 0);
            for (int c = 1; c < Dim; ++c) r(a, b) += m_s(a, c) * m(b, c);
        }
    return r;
}

}  // namespace spam

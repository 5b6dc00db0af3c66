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

}  // namespace spam

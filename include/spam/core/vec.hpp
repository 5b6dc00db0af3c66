// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/in_each_dimension.hpp>

#include <array>
#include <cmath>
#include <cstddef>

/// Small vectors for the bodies of pair sums. The arithmetic type T is a template parameter,
/// because a pair body is written once and compiled for `double` (oracle, tests) as well as for
/// vectors of lanes. Eigen stays outside the pair loops: it is for whole fields (state.hpp).
namespace spam {

template <int Dim, class T = double>
struct Vec {
    std::array<T, Dim> c{};

    constexpr T& operator[](int a) { return c[static_cast<std::size_t>(a)]; }
    constexpr const T& operator[](int a) const { return c[static_cast<std::size_t>(a)]; }

    constexpr Vec& operator+=(const Vec& o) {
        for (int a = 0; a < Dim; ++a) (*this)[a] += o[a];
        return *this;
    }
    constexpr Vec& operator-=(const Vec& o) {
        for (int a = 0; a < Dim; ++a) (*this)[a] -= o[a];
        return *this;
    }
    constexpr Vec& operator*=(const T& s) {
        for (int a = 0; a < Dim; ++a) (*this)[a] *= s;
        return *this;
    }
    friend constexpr Vec operator+(Vec a, const Vec& b) { return a += b; }
    friend constexpr Vec operator-(Vec a, const Vec& b) { return a -= b; }
    friend constexpr Vec operator*(const T& s, Vec a) { return a *= s; }
    friend constexpr bool operator==(const Vec&, const Vec&) = default;
};

/// The Vec, Mat or SymTensor whose numbers begin there.
template <class Value>
Value numbers_at(const double* from) {
    Value value;
    for (std::size_t k = 0; k < value.c.size(); ++k) value.c[k] = from[k];
    return value;
}

template <int Dim, class T>
constexpr T dot(const Vec<Dim, T>& a, const Vec<Dim, T>& b) {
    T s = a[0] * b[0];
    for (int k = 1; k < Dim; ++k) s += a[k] * b[k];
    return s;
}

/// z component of a x b: the plane's only rotation axis.
template <class T>
constexpr T cross(const Vec<2, T>& a, const Vec<2, T>& b) {
    return a[0] * b[1] - a[1] * b[0];
}

/// a x b in space.
template <class T>
constexpr Vec<3, T> cross(const Vec<3, T>& a, const Vec<3, T>& b) {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// max(x, 0), exactly, and without the branch that a compiler makes of max in scalar code: near the
/// range of a weight function it would be mispredicted again and again.
inline double positive_part(double x) { return 0.5 * (x + std::abs(x)); }

/// x to the nearest whole number, halves to even.
inline double nearest_integer(double x) { return std::nearbyint(x); }

}  // namespace spam

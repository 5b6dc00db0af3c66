// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/lanes.hpp>
#include <spam/core/vec.hpp>

#include <cmath>

namespace spam {

/// What every pair body sees of a pair. Differences are j minus i: a register of particles i is then
/// the operand that may stay in memory, which saves a load each.
template <int Dim, class T>
struct Pair {
    Vec<Dim, T> r_ji;  ///< r_j - r_i
    T r2, r;
    T w;                 ///< w_ij
    T minus_slope;       ///< -w'/r
    Vec<Dim, T> grad_w;  ///< gradient of w_ij at i: -(w'/r) r_ji
    Vec<Dim, T> v_ji;    ///< v_j - v_i
};

/// The part of a pair that takes longest: a sweep begins it some neighbours ahead of the rest.
template <int Dim, class T>
struct Separation {
    Vec<Dim, T> r_ji;
    T r2, r;
};

/// `Light`: whatever is done with the pair is quicker than a square root, which then is better made of
/// products.
template <int Dim, bool Light = false, class T>
constexpr Separation<Dim, T> separation(const Vec<Dim, T>& x_i, const Vec<Dim, T>& x_j) {
    using std::sqrt;
    Separation<Dim, T> s;
    // Rounded before anything is made of it: seen from j it must be exactly opposite, whatever a compiler
    // fuses.
    for (int a = 0; a < Dim; ++a) s.r_ji[a] = rounded(x_j[a] - x_i[a]);
    if constexpr (Light) {
        s.r2 = T(1e-300);  // a particle's distance from itself must not be divided by
        for (int a = 0; a < Dim; ++a) s.r2 += s.r_ji[a] * s.r_ji[a];
        s.r = sqrt_by_products(s.r2);
    } else {
        s.r2 = dot(s.r_ji, s.r_ji);
        s.r = sqrt(s.r2);
    }
    return s;
}

/// Everything a pair body may ask of a pair; velocities where records hold them. Exactly
/// antisymmetric: exchanging i and j flips the signs of r_ji, grad_w and v_ji and changes no other
/// bit.
template <int Dim, class T, class Weight, class Record>
constexpr Pair<Dim, T> make_pair(const Weight& weight, const Separation<Dim, T>& s, const Record& i,
                                 const Record& j) {
    Pair<Dim, T> pair;
    pair.r_ji = s.r_ji;
    pair.r2 = s.r2;
    pair.r = s.r;
    pair.w = weight.value(s.r);
    pair.minus_slope = weight.minus_slope_over_r(s.r);
    pair.grad_w = pair.minus_slope * s.r_ji;
    if constexpr (requires { j.v; }) pair.v_ji = j.v - i.v;
    return pair;
}

}  // namespace spam

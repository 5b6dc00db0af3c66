// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>

#include <cmath>

namespace spam {

/// What every pair body sees of a pair. Differences are j minus i: a register of particles i is then
/// the operand that may stay in memory, which saves a load each.
template <int Dim, class T>
struct Pair {
    Vec<Dim, T> r_ji;  ///< r_j - r_i
    T r2;
    T w;                 ///< w_ij
    Vec<Dim, T> grad_w;  ///< gradient of w_ij at i: -(w'/r) r_ji
    Vec<Dim, T> v_ji;    ///< v_j - v_i
};

/// Space without images.
struct OpenSpace {
    template <class T>
    constexpr T nearest_image(int, const T& s) const {
        return s;
    }
};

/// Everything a pair body may ask of a pair, from two records that hold at least x and v.
/// `space`: OpenSpace, or a Box. Exactly antisymmetric: exchanging i and j flips the signs of r_ji,
/// grad_w and v_ji and changes no other bit.
template <int Dim, class T, class Weight, class Space, class Record>
constexpr Pair<Dim, T> make_pair(const Weight& weight, const Space& space, const Record& i,
                                 const Record& j) {
    using std::sqrt;
    Pair<Dim, T> pair;
    for (int a = 0; a < Dim; ++a) pair.r_ji[a] = space.nearest_image(a, j.x[a] - i.x[a]);
    pair.r2 = dot(pair.r_ji, pair.r_ji);
    const T r = sqrt(pair.r2);
    pair.w = weight.value(r);
    pair.grad_w = weight.minus_slope_over_r(r) * pair.r_ji;
    pair.v_ji = j.v - i.v;
    return pair;
}

}  // namespace spam

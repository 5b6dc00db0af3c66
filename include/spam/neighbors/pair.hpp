// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>

#include <cmath>

namespace spam {

/// What every pair body sees of a pair: i minus j. The mass of j is a factor of every sum.
template <int Dim, class T>
struct Pair {
    Vec<Dim, T> r_ij;
    T r2;
    T m_w;                 ///< m_j w_ij
    Vec<Dim, T> m_grad_w;  ///< m_j grad_i w_ij = m_j (w'/r) r_ij
    Vec<Dim, T> v_ij;
};

/// Space without images.
struct OpenSpace {
    template <class T>
    constexpr T nearest_image(int, const T& s) const {
        return s;
    }
};

/// Everything a pair body may ask of a pair, from two records that hold at least x, v and m.
/// `space`: OpenSpace, or a Box. Exactly antisymmetric for equal masses: exchanging i and j flips
/// the signs of r_ij, m_grad_w and v_ij and changes no other bit.
template <int Dim, class T, class Weight, class Space, class Record>
constexpr Pair<Dim, T> make_pair(const Weight& weight, const Space& space, const Record& i,
                                 const Record& j) {
    using std::sqrt;
    Pair<Dim, T> pair;
    for (int a = 0; a < Dim; ++a) pair.r_ij[a] = space.nearest_image(a, i.x[a] - j.x[a]);
    pair.r2 = dot(pair.r_ij, pair.r_ij);
    const T r = sqrt(pair.r2);
    pair.m_w = j.m * weight.value(r);
    pair.m_grad_w = (j.m * weight.slope_over_r(r)) * pair.r_ij;
    pair.v_ij = i.v - j.v;
    return pair;
}

}  // namespace spam

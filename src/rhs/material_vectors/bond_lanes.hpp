// SPDX-License-Identifier: GPL-3.0-or-later
// What loops over bonds share. For *.lanes.cpp only: what stands here is compiled once for every instruction set.
#pragma once

#include "bond_sweeps.hpp"
#include <spam/core/lanes.hpp>

namespace spam {
namespace {

constexpr int W = native_lanes(InstructionSet::SPAM_LEVEL);
using T = Lanes<W>;

/// Number `at` of W records that lie `stride` apart.
SPAM_INLINE T from_records(const double* record, std::size_t stride, std::size_t at) {
    T x;
    for (std::size_t l = 0; l < W; ++l) set_lane(x, static_cast<int>(l), record[l * stride + at]);
    return x;
}
SPAM_INLINE void to_records(double* record, std::size_t stride, std::size_t at, const T& x) {
    for (std::size_t l = 0; l < W; ++l) record[l * stride + at] = lane(x, static_cast<int>(l));
}

/// W counting numbers below 2^31 that lie together.
SPAM_INLINE T load_numbers(const std::uint32_t* from) {
    typedef std::int32_t Integers __attribute__((vector_size(4 * W)));
    Integers integers;
    __builtin_memcpy(&integers, from, sizeof integers);
    return __builtin_convertvector(integers, T::Vector);
}

/// The Dim numbers that begin at Dim times these indices.
template <int Dim>
SPAM_INLINE Vec<Dim, T> load_points(const double* from, const std::uint32_t* index) {
    Vec<Dim, T> x;
    const auto at = [&](int l) SPAM_FLAT { return from + std::size_t{Dim} * index[l]; };
#if defined(__AVX512F__)
    if constexpr (Dim == 2 && W == 8) {  // both numbers at once, even lanes in one register
        const auto half = [&](int l) SPAM_FLAT {
            const __m256d low = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(at(l))),
                                                     _mm_loadu_pd(at(l + 2)), 1);
            const __m256d high = _mm256_insertf128_pd(
                _mm256_castpd128_pd256(_mm_loadu_pd(at(l + 4))), _mm_loadu_pd(at(l + 6)), 1);
            return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(low), high, 1);
        };
        const __m512d even = half(0), odd = half(1);
        x[0] = T(T::Vector(_mm512_maskz_unpacklo_pd(0xff, even, odd)));
        x[1] = T(T::Vector(_mm512_maskz_unpackhi_pd(0xff, even, odd)));
        return x;
    }
#elif defined(__AVX__)
    if constexpr (Dim == 2 && W == 4) {
        const auto half = [&](int l) SPAM_FLAT {
            return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(at(l))),
                                        _mm_loadu_pd(at(l + 2)), 1);
        };
        const __m256d even = half(0), odd = half(1);
        x[0] = T(T::Vector(_mm256_unpacklo_pd(even, odd)));
        x[1] = T(T::Vector(_mm256_unpackhi_pd(even, odd)));
        return x;
    }
#endif
    for (int a = 0; a < Dim; ++a)
        for (int l = 0; l < W; ++l) set_lane(x[a], l, at(l)[a]);
    return x;
}

/// To W places that lie together, in the order of place_of_lane().
template <int Dim>
SPAM_INLINE void store_points(double* to, const Vec<Dim, T>& x) {
#if defined(__AVX512F__)
    if constexpr (Dim == 2 && W == 8) {
        const __m512d a = (__m512d)x[0].v, b = (__m512d)x[1].v;
        store_lanes(to, T(T::Vector(_mm512_maskz_unpacklo_pd(0xff, a, b))));
        store_lanes(to + W, T(T::Vector(_mm512_maskz_unpackhi_pd(0xff, a, b))));
        return;
    }
#elif defined(__AVX__)
    if constexpr (Dim == 2 && W == 4) {
        const __m256d a = (__m256d)x[0].v, b = (__m256d)x[1].v;
        store_lanes(to, T(T::Vector(_mm256_unpacklo_pd(a, b))));
        store_lanes(to + W, T(T::Vector(_mm256_unpackhi_pd(a, b))));
        return;
    }
#endif
    for (int a = 0; a < Dim; ++a)
        for (int l = 0; l < W; ++l)
            to[place_of_lane(static_cast<std::size_t>(l), W) * Dim + static_cast<std::size_t>(a)] =
                lane(x[a], l);
}

/// The bonds of a group from `bond` on, one for each lane.
template <int Dim>
SPAM_INLINE void load_vector(const BondView<Dim>& view, std::size_t bond, Vec<Dim, T>& X, T& g) {
    const double* const numbers = view.vectors + bond * BondView<Dim>::vector_numbers;
    for (int a = 0; a < Dim; ++a) X[a] = load_lanes<W>(numbers + a * W);
    g = load_lanes<W>(numbers + Dim * W);
}

/// The positions of the particles of a group.
template <int Dim>
SPAM_INLINE Vec<Dim, T> load_group(const BondView<Dim>& view, std::size_t group) {
    Vec<Dim, T> x;
    for (int a = 0; a < Dim; ++a)
        x[a] = from_records(view.x + group * W * Dim, Dim, static_cast<std::size_t>(a));
    return x;
}

/// r_kj of the bonds of a group from `bond` on, one for each lane.
template <int Dim, bool Periodic>
SPAM_INLINE Vec<Dim, T> separations(const BondView<Dim>& view, std::size_t bond,
                                    const Vec<Dim, T>& x_k) {
    Vec<Dim, T> r = load_points<Dim>(view.x, view.partner + bond);
    for (int a = 0; a < Dim; ++a) {
        r[a] -= x_k[a];
        if constexpr (Periodic)
            r[a] -= T(view.length[a]) * nearest_integer(r[a] * T(view.inverse_length[a]));
    }
    return r;
}

template <int Dim>
struct Fitted {
    Mat<Dim, T> F;
    SymTensor<Dim, T> K;  ///< N^-1
};

/// `keep(bond, r)` is told of all separations.
template <int Dim, bool Periodic, class Keep>
SPAM_INLINE Fitted<Dim> fit_group(const BondView<Dim>& view, std::size_t group, double little,
                                  const Keep& keep) {
    const Vec<Dim, T> x_k = load_group<Dim>(view, group);
    BondFit<Dim, T> sums;
    for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
        const Vec<Dim, T> r = separations<Dim, Periodic>(view, bond, x_k);
        Vec<Dim, T> X;
        T g;
        keep(bond, r);
        load_vector(view, bond, X, g);
        sums.add(g * BondFade<T>(dot(r, r), view.inverse_range).s, r, X);
    }
    const FitSolver<Dim, T> solver(sums.N, little);
    return {solver.divided(sums.A), solver.inverse()};
}

}  // namespace
}  // namespace spam

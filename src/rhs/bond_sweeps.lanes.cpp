// SPDX-License-Identifier: GPL-3.0-or-later
#include "bond_sweeps.hpp"

#include <spam/core/lanes.hpp>
#include <spam/physics/material_vectors.hpp>

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

template <int Dim, bool Periodic>
void fit(const BondView<Dim>& view, const double* x, double* records, std::size_t first,
         std::size_t last) {
    using R = BondRecord<Dim>;
    for (std::size_t group = first; group < last; ++group) {
        Vec<Dim, T> x_k;
        for (int a = 0; a < Dim; ++a)
            x_k[a] = from_records(x + group * W * Dim, Dim, static_cast<std::size_t>(a));
        BondFit<Dim, T> sums;
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
            Vec<Dim, T> r = load_points<Dim>(x, view.partner + bond), X;
            T g;
            for (int a = 0; a < Dim; ++a) {
                r[a] -= x_k[a];
                if constexpr (Periodic)
                    r[a] -= T(view.length[a]) * nearest_integer(r[a] * T(view.inverse_length[a]));
                store_lanes(view.t + bond * Dim + a * W, r[a]);
            }
            load_vector(view, bond, X, g);
            sums.add(g * BondFade<T>(dot(r, r), view.inverse_range).s, r, X);
        }
        const FitSolver<Dim, T> solver(sums.N, view.little);
        const SymTensor<Dim, T> K = solver.inverse();
        const Mat<Dim, T> F = solver.divided(sums.A);
        double* const record = records + (group - first) * W * R::numbers;
        for (std::size_t c = 0; c < R::square; ++c)
            to_records(record, R::numbers, R::F + c, F.c[c]);
        for (std::size_t c = 0; c < R::symmetric; ++c)
            to_records(record, R::numbers, R::K + c, K.c[c]);
    }
}

template <int Dim, bool Whole>
void forces_of(const BondView<Dim>& view, const double* records, double* v_dot, std::size_t first,
               std::size_t last) {
    using R = BondRecord<Dim>;
    for (std::size_t group = first; group < last; ++group) {
        const double* const record = records + (group - first) * W * R::numbers;
        BondLaw<Dim, T> law;
        for (std::size_t c = 0; c < R::square; ++c) {
            law.F.c[c] = from_records(record, R::numbers, R::F + c);
            law.G.c[c] = from_records(record, R::numbers, R::G + c);
        }
        if constexpr (!Whole)
            for (std::size_t c = 0; c < R::symmetric; ++c)
                law.H.c[c] = from_records(record, R::numbers, R::H + c);
        law.c = from_records(record, R::numbers, R::c);
        Vec<Dim, T> own;
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
            double* const t = view.t + bond * Dim;
            Vec<Dim, T> r, X;
            T g;
            for (int a = 0; a < Dim; ++a) r[a] = load_lanes<W>(t + a * W);
            load_vector(view, bond, X, g);
            const Vec<Dim, T> force = law.template force<Whole>(g, r, X, view.inverse_range);
            own += force;
            store_points<Dim>(t, force);
        }
        for (std::size_t l = 0; l < W && group * W + l < view.particles; ++l)
            for (std::size_t a = 0; a < Dim; ++a)
                v_dot[(group * W + l) * Dim + a] = lane(own.c[a], static_cast<int>(l));
    }
}

template <int Dim>
void forces(const BondView<Dim>& view, const double* records, bool whole, double* v_dot,
            std::size_t first, std::size_t last) {
    whole ? forces_of<Dim, true>(view, records, v_dot, first, last)
          : forces_of<Dim, false>(view, records, v_dot, first, last);
}

template <int Dim>
void gather(const BondView<Dim>& view, const double* mass, double* v_dot, std::size_t first,
            std::size_t last) {
    for (std::size_t group = first; group < last; ++group) {
        Vec<Dim, T> back;
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W)
            back += load_points<Dim>(view.t, view.reverse + bond);
        for (std::size_t l = 0; l < W && group * W + l < view.particles; ++l) {
            const std::size_t i = group * W + l;
            for (std::size_t a = 0; a < Dim; ++a)
                v_dot[i * Dim + a] =
                    (v_dot[i * Dim + a] - lane(back.c[a], static_cast<int>(l))) / mass[i];
        }
    }
}

}  // namespace

template <int Dim, InstructionSet Level>
BondSweeps<Dim> bond_sweeps(bool periodic) {
    return {W, periodic ? fit<Dim, true> : fit<Dim, false>, forces<Dim>, gather<Dim>};
}

template BondSweeps<2> bond_sweeps<2, InstructionSet::SPAM_LEVEL>(bool);
template BondSweeps<3> bond_sweeps<3, InstructionSet::SPAM_LEVEL>(bool);

}  // namespace spam

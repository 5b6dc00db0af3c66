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

template <int Dim, bool Periodic>
void fit(const BondView<Dim>& view, double* records, std::size_t first, std::size_t last) {
    using R = BondRecord<Dim>;
    for (std::size_t group = first; group < last; ++group) {
        const Fitted<Dim> fitted = fit_group<Dim, Periodic>(
            view, group, view.little, [&](std::size_t bond, const Vec<Dim, T>& r) SPAM_FLAT {
                for (int a = 0; a < Dim; ++a) store_lanes(view.t + bond * Dim + a * W, r[a]);
            });
        double* const record = records + (group - first) * W * R::numbers;
        for (std::size_t c = 0; c < R::square; ++c)
            to_records(record, R::numbers, R::F + c, fitted.F.c[c]);
        for (std::size_t c = 0; c < R::symmetric; ++c)
            to_records(record, R::numbers, R::K + c, fitted.K.c[c]);
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

/// 1 in the lanes of others that are nearer than that, 0 in those of the particle itself.
SPAM_INLINE T nearer(const T& r2, double reach2) {
    return where_below(T(0.0), r2, where_below(r2, T(reach2), T(1.0)));
}

template <int Dim>
void count(const ClusterView& list, const double* records, double reach2, double* neighbours,
           std::size_t first, std::size_t last) {
    constexpr std::size_t stride = Dim + 1;
    for (std::size_t c = first; c < last; ++c) {
        Vec<Dim + 1, T> own;
        for (std::size_t a = 0; a < stride; ++a)
            own.c[a] = from_records(records + c * W * stride, stride, a);
        const auto range = list.range[c];
        const std::uint32_t* const entries = list.slices[c / ClusterView::slice_size] + range.first;
        T near{};
        for (std::uint32_t n = 0; n < range.count; ++n) {
            const double* const other = records + entries[n];
            T r2{};
            for (std::size_t a = 0; a < stride; ++a) {
                const T r = T(other[a]) - own.c[a];
                r2 += r * r;
            }
            near += nearer(r2, reach2);
        }
        for (std::size_t l = 0; l < W && c * W + l < list.particles; ++l)
            neighbours[list.order[c * W + l]] = lane(near, static_cast<int>(l));
    }
}

/// F^-1. Where neighbours do not span space (Wholeness::spans) or F is all but singular there is none, and 1,
/// for separations themselves, is as good as any.
template <int Dim>
SPAM_INLINE Mat<Dim, T> anchoring(const Fitted<Dim>& fitted, double N0) {
    T trace{};
    for (int a = 0; a < Dim; ++a) trace += fitted.K(a, a);
    const T J = determinant(fitted.F);
    const T usable = where_below(T(Wholeness::spanning * N0) * trace, T(double{Dim}),
                                 where_below(T(1e-6), J * J, T(1.0)));
    Mat<Dim, T> F;  // 1 where there is none, before anything is divided
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) {
            F(a, b) = where_below(T(0.5), usable, fitted.F(a, b));
            if (a == b) F(a, b) += T(1.0) - usable;
        }
    return inverse(F);
}

/// New numbers in the lanes where r2 is not below the limit.
SPAM_INLINE void replace_beyond(double* numbers, const T& r2, double limit2, const T& value) {
    store_lanes(numbers, where_below(r2, T(limit2), load_lanes<W>(numbers)) +
                             (value - where_below(r2, T(limit2), value)));
}

/// MaterialWeight, in lanes.
SPAM_INLINE T weight_of(const MaterialWeight& weight, const T& length, double range) {
    const T z = positive_part(T(1.0) - length / T(weight.reach * range));
    if (weight.power == 2.0) return z * z;
    T g;
    for (int l = 0; l < W; ++l)
        set_lane(g, l, lane(z, l) > 0.0 ? __builtin_pow(lane(z, l), weight.power) : 0.0);
    return g;
}

template <int Dim, bool Periodic>
void renew(const BondView<Dim>& view, const BondRenewal<Dim>& renewal, std::size_t first,
           std::size_t last) {
    const double reach2 = renewal.reach2, range = 1.0 / view.inverse_range, range2 = range * range;
    for (std::size_t group = first; group < last; ++group) {
        const auto fitted = fit_group<Dim, Periodic>(
            view, group, view.little, [](std::size_t, const Vec<Dim, T>&) SPAM_FLAT {});
        const Mat<Dim, T> back = anchoring(fitted, renewal.N0);
        for (std::size_t c = 0; c < back.c.size(); ++c)
            to_records(renewal.anchoring + group * W * back.c.size(), back.c.size(), c, back.c[c]);
        const Vec<Dim, T> x_k = load_group<Dim>(view, group);
        T left{}, idle{};
        unsigned gone = 0;
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
            const Vec<Dim, T> r = separations<Dim, Periodic>(view, bond, x_k);
            const T r2 = dot(r, r);
            double* const numbers = view.vectors + bond * BondView<Dim>::vector_numbers;
            left += nearer(r2, reach2);
            idle += where_below(load_lanes<W>(numbers + Dim * W), T(1e-300), nearer(r2, range2));
            if (lanes_below(r2, T(range2)) == (1U << W) - 1) continue;
            const Vec<Dim, T> X = back * r;
            for (int a = 0; a < Dim; ++a) replace_beyond(numbers + a * W, r2, range2, X[a]);
            replace_beyond(numbers + Dim * W, r2, range2,
                           weight_of(renewal.weight, sqrt(dot(X, X)), range));
            for (unsigned far = lanes_below(T(reach2), r2); far != 0; far &= far - 1, ++gone) {
                const auto l = static_cast<std::size_t>(__builtin_ctz(far));
                view.partner[bond + l] = static_cast<std::uint32_t>(group * W + l);
                view.reverse[bond + l] = static_cast<std::uint32_t>(bond + place_of_lane(l, W));
                for (int a = 0; a <= Dim; ++a) numbers[static_cast<std::size_t>(a * W) + l] = 0.0;
            }
        }
        const unsigned fewer = lanes_below(left, load_lanes<W>(renewal.neighbours + group * W));
        renewal.found[group] = {static_cast<unsigned char>(fewer),
                                static_cast<unsigned char>(lanes_below(T(0.5), idle)), gone};
    }
}

template <int Dim>
void beyond(const BondView<Dim>& view, const double* records, double misfit2, double stretch2,
            unsigned char* found, std::size_t first, std::size_t last) {
    using R = BondRecord<Dim>;
    for (std::size_t group = first; group < last; ++group) {
        Mat<Dim, T> F;
        for (std::size_t c = 0; c < R::square; ++c)
            F.c[c] = from_records(records + (group - first) * W * R::numbers, R::numbers, R::F + c);
        unsigned lanes = 0;
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
            Vec<Dim, T> r, X;
            T g;
            for (int a = 0; a < Dim; ++a) r[a] = load_lanes<W>(view.t + bond * Dim + a * W);
            load_vector(view, bond, X, g);
            const Vec<Dim, T> FX = F * X, e = r - FX;
            const T r2 = dot(r, r);
            const unsigned weighs =
                lanes_below(T(0.0), g) &
                lanes_below(r2 * T(view.inverse_range * view.inverse_range), T(1.0));
            lanes |= weighs & (lanes_below(T(misfit2) * dot(FX, FX), dot(e, e)) |
                               lanes_below(T(stretch2) * dot(X, X), r2));
        }
        found[group - first] = static_cast<unsigned char>(lanes);
    }
}

}  // namespace

template <int Dim, InstructionSet Level>
BondSweeps<Dim> bond_sweeps(bool periodic) {
    if (periodic)
        return {W,          fit<Dim, true>,   forces<Dim>, gather<Dim>,
                count<Dim>, renew<Dim, true>, beyond<Dim>};
    return {W,          fit<Dim, false>,   forces<Dim>, gather<Dim>,
            count<Dim>, renew<Dim, false>, beyond<Dim>};
}

template BondSweeps<2> bond_sweeps<2, InstructionSet::SPAM_LEVEL>(bool);
template BondSweeps<3> bond_sweeps<3, InstructionSet::SPAM_LEVEL>(bool);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over bonds that not every right-hand side needs.
#include "bond_lanes.hpp"

#include <type_traits>

namespace spam {
namespace {

/// 1 in the lanes of others that are nearer than that, 0 in those of the particle itself.
SPAM_INLINE T nearer(const T& r2, double reach2) {
    return where_below(T(0.0), r2, where_below(r2, T(reach2), T(1.0)));
}

/// NeighbourSums in lanes.
struct Sums {
    T count{}, sum{}, squares{};

    SPAM_INLINE void add(const T& one, const T& number) {
        const T own = one * number;
        count += one;
        sum += own;
        squares += own * number;
    }
};

template <int Dim>
void count(const ClusterView& list, const double* records, double reach2, double* neighbours,
           std::size_t first, std::size_t last) {
    using N = NeighbourSums;
    constexpr std::size_t stride = Dim + 2;
    for (std::size_t c = first; c < last; ++c) {
        Vec<Dim + 1, T> own;
        for (std::size_t a = 0; a <= Dim; ++a)
            own.c[a] = from_records(records + c * W * stride, stride, a);
        const ClusterView::Entries entries = list.entries[c];
        Sums near;
        for (std::uint32_t n = 0; n < entries.count; ++n) {
            const double* const other = records + entries.first[n];
            T r2{};
            for (std::size_t a = 0; a <= Dim; ++a) {
                const T r = T(other[a]) - own.c[a];
                r2 += r * r;
            }
            near.add(nearer(r2, reach2), T(other[Dim + 1]));
        }
        for (std::size_t l = 0; l < W && c * W + l < list.particles; ++l) {
            double* const sums = neighbours + list.order[c * W + l] * N::numbers;
            sums[N::count] = lane(near.count, static_cast<int>(l));
            sums[N::sum] = lane(near.sum, static_cast<int>(l));
            sums[N::squares] = lane(near.squares, static_cast<int>(l));
        }
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
    if (weight.power == 4.0) return (z * z) * (z * z);
    T g;
    for (int l = 0; l < W; ++l)
        set_lane(g, l, lane(z, l) > 0.0 ? __builtin_pow(lane(z, l), weight.power) : 0.0);
    return g;
}

/// Takes what rows hold off the sums of neighbours; the lanes where some are left.
SPAM_INLINE unsigned take_off(const Sums& held, double* missing) {
    using N = NeighbourSums;
    const auto left = [&](std::size_t at, const T& own) SPAM_FLAT {
        const T rest = from_records(missing, N::numbers, at) - own;
        to_records(missing, N::numbers, at, rest);
        return rest;
    };
    left(N::sum, held.sum);
    left(N::squares, held.squares);
    return lanes_below(T(0.5), left(N::count, held.count));
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
        Sums held;
        T idle{};
        unsigned gone = 0;
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
            const Vec<Dim, T> r = separations<Dim, Periodic>(view, bond, x_k);
            const T r2 = dot(r, r);
            double* const numbers = view.vectors + bond * BondView<Dim>::vector_numbers;
            held.add(nearer(r2, reach2), load_numbers(view.partner + bond));
            idle += where_below(load_lanes<W>(numbers + Dim * W), T(1e-300), nearer(r2, range2));
            if (lanes_below(r2, T(range2)) == (1U << W) - 1) continue;
            const Vec<Dim, T> X = back * r;
            for (int a = 0; a < Dim; ++a) replace_beyond(numbers + a * W, r2, range2, X[a]);
            replace_beyond(numbers + Dim * W, r2, range2,
                           weight_of(renewal.weight, sqrt(dot(X, X)), range));
            for (unsigned far = lanes_below(T(reach2), r2); far != 0; far &= far - 1, ++gone) {
                const auto l = static_cast<std::size_t>(__builtin_ctz(far));
                view.partner[bond + l] = static_cast<std::uint32_t>(group * W + l);
                view.reverse[bond + l] =
                    static_cast<std::uint32_t>(view.place(group, bond) + place_of_lane(l, W));
                for (int a = 0; a <= Dim; ++a) numbers[static_cast<std::size_t>(a * W) + l] = 0.0;
            }
        }
        const unsigned fewer = take_off(held, renewal.missing + group * W * NeighbourSums::numbers);
        renewal.found[group] = {static_cast<unsigned char>(fewer),
                                static_cast<unsigned char>(lanes_below(T(0.5), idle)), gone};
    }
}

template <int Dim, bool Periodic>
void beyond(const BondView<Dim>& view, const double* records, double misfit2, double stretch2,
            unsigned char* found, std::size_t first, std::size_t last) {
    using R = BondRecord<Dim>;
    for (std::size_t group = first; group < last; ++group) {
        Mat<Dim, T> F;
        for (std::size_t c = 0; c < R::square; ++c)
            F.c[c] = from_records(records + (group - first) * W * R::numbers, R::numbers, R::F + c);
        const Vec<Dim, T> x_k = load_group<Dim>(view, group);
        unsigned lanes = 0;
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
            const Vec<Dim, T> r = separations<Dim, Periodic>(view, bond, x_k);
            Vec<Dim, T> X;
            T g;
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

template <int Dim, bool Periodic>
void misfits(const BondView<Dim>& view, double* records, std::size_t first, std::size_t last) {
    using R = BondRecord<Dim>;
    for (std::size_t group = first; group < last; ++group) {
        double* const own = records + (group - first) * W * R::numbers;
        Mat<Dim, T> F;
        for (std::size_t c = 0; c < R::square; ++c)
            F.c[c] = from_records(own, R::numbers, R::F + c);
        const Vec<Dim, T> x_k = load_group<Dim>(view, group);
        T misfit{};
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
            const Vec<Dim, T> r = separations<Dim, Periodic>(view, bond, x_k);
            Vec<Dim, T> X;
            T g;
            load_vector(view, bond, X, g);
            const Vec<Dim, T> e = r - F * X;
            misfit += g * BondFade<T>(dot(r, r), view.inverse_range).s * dot(e, e);
        }
        to_records(own, R::numbers, R::c, misfit);
    }
}

}  // namespace

template <int Dim, InstructionSet Level>
BondUpdates<Dim> bond_updates(bool periodic) {
    const auto all = [](auto across) {
        constexpr bool Periodic = decltype(across)::value;
        return BondUpdates<Dim>{count<Dim>, renew<Dim, Periodic>, beyond<Dim, Periodic>,
                                misfits<Dim, Periodic>};
    };
    return periodic ? all(std::true_type{}) : all(std::false_type{});
}

template BondUpdates<2> bond_updates<2, InstructionSet::SPAM_LEVEL>(bool);
template BondUpdates<3> bond_updates<3, InstructionSet::SPAM_LEVEL>(bool);

}  // namespace spam

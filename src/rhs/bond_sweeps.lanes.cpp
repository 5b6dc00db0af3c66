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
            Vec<Dim, T> r, X;
            T g;
            for (int a = 0; a < Dim; ++a) {
                for (std::size_t l = 0; l < W; ++l)
                    set_lane(r[a], static_cast<int>(l),
                             x[view.partner[bond + l] * std::size_t{Dim} + std::size_t(a)]);
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
        double* const record = records + group * W * R::numbers;
        for (std::size_t c = 0; c < R::square; ++c)
            to_records(record, R::numbers, R::F + c, F.c[c]);
        for (std::size_t c = 0; c < R::symmetric; ++c)
            to_records(record, R::numbers, R::K + c, K.c[c]);
    }
}

template <int Dim>
void forces(const BondView<Dim>& view, const double* records, std::size_t first, std::size_t last) {
    using R = BondRecord<Dim>;
    for (std::size_t group = first; group < last; ++group) {
        const double* const record = records + group * W * R::numbers;
        BondLaw<Dim, T> law;
        for (std::size_t c = 0; c < R::square; ++c) {
            law.F.c[c] = from_records(record, R::numbers, R::F + c);
            law.G.c[c] = from_records(record, R::numbers, R::G + c);
        }
        for (std::size_t c = 0; c < R::symmetric; ++c)
            law.H.c[c] = from_records(record, R::numbers, R::H + c);
        law.c = from_records(record, R::numbers, R::c);
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W) {
            double* const t = view.t + bond * Dim;
            Vec<Dim, T> r, X;
            T g;
            for (int a = 0; a < Dim; ++a) r[a] = load_lanes<W>(t + a * W);
            load_vector(view, bond, X, g);
            const Vec<Dim, T> force = law.force(g, r, X, view.inverse_range);
            for (int a = 0; a < Dim; ++a) store_lanes(t + a * W, force[a]);
        }
    }
}

template <int Dim>
void gather(const BondView<Dim>& view, const double* mass, double* v_dot, std::size_t first,
            std::size_t last) {
    for (std::size_t group = first; group < last; ++group) {
        Vec<Dim, T> sum;
        for (std::size_t bond = view.first[group]; bond < view.first[group + 1]; bond += W)
            for (int a = 0; a < Dim; ++a) {
                T back;
                for (std::size_t l = 0; l < W; ++l)
                    set_lane(back, static_cast<int>(l),
                             view.t[view.reverse[bond + l] + std::size_t(a * W)]);
                sum[a] += load_lanes<W>(view.t + bond * Dim + a * W) - back;
            }
        for (std::size_t l = 0; l < W; ++l) {
            const std::size_t i = group * W + l;
            if (i >= view.particles) break;
            for (int a = 0; a < Dim; ++a)
                v_dot[i * Dim + std::size_t(a)] = lane(sum[a], static_cast<int>(l)) / mass[i];
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

// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over bonds of every right-hand side.
#include "bond_lanes.hpp"

#include <type_traits>

namespace spam {
namespace {

template <int Dim, bool Periodic, bool Kept>
void fit(const BondView<Dim>& view, double* records, std::size_t first, std::size_t last) {
    using R = BondRecord<Dim>;
    for (std::size_t group = first; group < last; ++group) {
        const auto keep = [&](std::size_t bond, const Vec<Dim, T>& r) SPAM_FLAT {
            if constexpr (Kept) {
                double* const t = view.t + view.place(group, bond) * Dim;
                for (int a = 0; a < Dim; ++a) store_lanes(t + a * W, r[a]);
            }
        };
        const Fitted<Dim> fitted = fit_group<Dim, Periodic>(view, group, view.little, keep);
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
            double* const t = view.t + view.place(group, bond) * Dim;
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
    const auto all = [](auto across) {
        constexpr bool Periodic = decltype(across)::value;
        return BondSweeps<Dim>{W, fit<Dim, Periodic, true>, fit<Dim, Periodic, false>, forces<Dim>,
                               gather<Dim>};
    };
    return periodic ? all(std::true_type{}) : all(std::false_type{});
}

template BondSweeps<2> bond_sweeps<2, InstructionSet::SPAM_LEVEL>(bool);
template BondSweeps<3> bond_sweeps<3, InstructionSet::SPAM_LEVEL>(bool);

}  // namespace spam

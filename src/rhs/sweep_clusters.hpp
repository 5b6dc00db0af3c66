// SPDX-License-Identifier: GPL-3.0-or-later
// For *.lanes.cpp of this room.
#pragma once

#include "sweeps.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/sweep.hpp>
#include <spam/physics/density_sum.hpp>

namespace spam {
inline namespace SPAM_LANES {

/// sweep_block() in a function of its own: the loop has the registers to itself, and is compiled once
/// wherever it is called from.
template <int W, int Dim, class R, class... Passes, class Weight, class Space, class Store>
[[gnu::flatten, gnu::noinline]] void sweep_run(const SweepInput<Dim>& in, std::size_t begin,
                                               std::size_t end, const Weight& weight,
                                               const Space& space, const Store& store_sums,
                                               const std::tuple<Passes...>& passes) {
    // Copies, which nothing outside can change: they save instructions in the loop.
    const Weight own = weight;
    const ClusterView list = in.list;
    const Records records = in.records;
    sweep_block<W, Dim, R, Passes...>(list, begin, end, own, space, records, store_sums, passes);
}

/// With its constants where it has any.
template <class Pass, int Dim>
Pass pass_of(const SweepInput<Dim>& in) {
    if constexpr (requires { Pass::with(in.constants); })
        return Pass::with(in.constants);
    else
        return {};
}

/// Lucy's own formula, looking for nearest images only where there are any: in a periodic box runs of
/// clusters that have images for neighbours and runs that have none. On a line looking costs less than
/// compiling twice.
struct LucysSweep {
    template <int W, int Dim, class R, class... Passes, class Store>
    static void run(const SweepInput<Dim>& in, std::size_t begin, std::size_t end,
                    const Store& store, const std::tuple<Passes...>& passes) {
        const Lucy<Dim> weight(in.range);
        const std::uint8_t* const direct = in.list.direct;
        for (std::size_t next = begin; begin < end; begin = next) {
            next = direct == nullptr ? end : begin + 1;
            while (next < end && direct[next] == direct[begin]) ++next;
            if (Dim > 1 && (direct == nullptr || direct[begin] != 0))
                sweep_run<W, Dim, R>(in, begin, next, weight, OpenSpace(), store, passes);
            else
                sweep_run<W, Dim, R>(in, begin, next, weight, *in.box, store, passes);
        }
    }
};

/// Any weight function, compiled once: nearest images are always looked for.
struct GeneralSweep {
    template <int W, int Dim, class R, class... Passes, class Store>
    static void run(const SweepInput<Dim>& in, std::size_t begin, std::size_t end,
                    const Store& store, const std::tuple<Passes...>& passes) {
        sweep_run<W, Dim, R>(in, begin, end, *in.weight, *in.box, store, passes);
    }
};

/// `Kind`: one of the two above.
template <class Kind, int W, int Dim, class R, class... Passes, class Store>
void sweep_clusters(const SweepInput<Dim>& in, std::size_t begin, std::size_t end,
                    const Store& store_sums) {
    Kind::template run<W, Dim, R>(in, begin, end, store_sums,
                                  std::tuple<Passes...>{pass_of<Passes>(in)...});
}

template <int Dim, class T>
SPAM_INLINE void store(double* field, std::size_t i, int l, const Vec<Dim, T>& value) {
    for (int a = 0; a < Dim; ++a) field[i * Dim + static_cast<std::size_t>(a)] = lane(value[a], l);
}

/// The density, summed, of all particles.
template <class Kind, int W, int Dim, class R>
void density_sweep(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<Kind, W, Dim, R, DensitySum>(
            in, begin, end, [&](std::size_t slot, const auto&, const auto& sums) {
                for_each_lane<W>(in.list, slot,
                                 [&](int l, std::size_t i) { out.rho[i] = lane(sums.rho, l); });
            });
    });
}

}  // namespace SPAM_LANES
}  // namespace spam

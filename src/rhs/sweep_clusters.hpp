// SPDX-License-Identifier: GPL-3.0-or-later
// For *.lanes.cpp of this room.
#pragma once

#include "sweeps.hpp"
#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/sweep.hpp>
#include <spam/physics/density_sum.hpp>

namespace spam {
inline namespace SPAM_LANES {

/// In a periodic box: runs of clusters that have images for neighbours and runs that have none.
template <int W, int Dim, class R, class... Passes, class Weight, class Store>
[[gnu::flatten, gnu::noinline]] void sweep_runs(const SweepInput<Dim>& in, std::size_t begin,
                                                std::size_t end, const Weight& weight,
                                                const Store& store_sums,
                                                const std::tuple<Passes...>& passes) {
    const std::uint8_t* const direct = in.list.direct;
    for (std::size_t next = begin; begin < end; begin = next) {
        while (++next < end && direct[next] == direct[begin]) continue;
        if (direct[begin] == 0)
            sweep_block<W, Dim, R, Passes...>(in.list, begin, next, weight, *in.box, in.records,
                                              store_sums, passes);
        else
            sweep_block<W, Dim, R, Passes...>(in.list, begin, next, weight, OpenSpace(), in.records,
                                              store_sums, passes);
    }
}

/// With its constants where it has any.
template <class Pass, int Dim>
Pass pass_of(const SweepInput<Dim>& in) {
    if constexpr (requires { Pass::with(in.viscosity); })
        return Pass::with(in.viscosity);
    else
        return {};
}

/// sweep_block() with Lucy's weight function, looking for nearest images only where there are any.
template <int W, int Dim, class R, class... Passes, class Store>
void sweep_clusters(const SweepInput<Dim>& in, std::size_t begin, std::size_t end,
                    const Store& store_sums) {
    const Lucy<Dim> weight(in.range);
    const std::tuple<Passes...> passes{pass_of<Passes>(in)...};
    if (in.list.direct != nullptr)
        sweep_runs<W, Dim, R, Passes...>(in, begin, end, weight, store_sums, passes);
    else
        sweep_block<W, Dim, R, Passes...>(in.list, begin, end, weight, OpenSpace(), in.records,
                                          store_sums, passes);
}

template <int Dim, class T>
SPAM_INLINE void store(double* field, std::size_t i, int l, const Vec<Dim, T>& value) {
    for (int a = 0; a < Dim; ++a) field[i * Dim + static_cast<std::size_t>(a)] = lane(value[a], l);
}

/// The density, summed, of all particles.
template <int W, int Dim, class R>
void density_sweep(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        sweep_clusters<W, Dim, R, DensitySum>(
            in, begin, end, [&](std::size_t slot, const auto&, const auto& sums) {
                for_each_lane<W>(in.list, slot,
                                 [&](int l, std::size_t i) { out.rho[i] = lane(sums.rho, l); });
            });
    });
}

}  // namespace SPAM_LANES
}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/lanes.hpp>
#include <spam/core/look_ahead.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/cluster_view.hpp>
#include <spam/neighbors/pair.hpp>

#include <algorithm>
#include <tuple>
#include <type_traits>

namespace spam {
inline namespace SPAM_LANES {

/// The compiler's own vector in a register, or the number that is one.
template <class T>
SPAM_INLINE auto& bare(T& x) {
    if constexpr (requires { x.v; })
        return x.v;
    else
        return x;
}

template <class Pass>
constexpr bool is_light() {
    if constexpr (requires { Pass::light; }) return Pass::light;
    return false;
}

/// One sweep over the pairs of the clusters [first, last), for one or more passes that need nothing
/// from each other, gather form: for each cluster of W particles i, in the lanes of T = LanesOf<W>,
/// the sums of every pass over its neighbours (themselves included), one neighbour j at a time in all
/// lanes; then store(first slot, i, sums...). Lanes out of range add exact zeros. A pass is a plain
/// type with
///     template <class T> struct Sums;
///     template <class T, class Record> static void add(pair, i, j, Sums<T>&);
/// (not static where the pass holds constants, which come with `passes`) and, where it does so little that a square
/// root would be waited for,
///     static constexpr bool light = true;
/// R: the record the passes need (record.hpp). W must be the list's width, the records'
/// stride the list's; images of particles must be up to date (ClusterList::refresh).
// Inlined where it is called, stores and all: callers are compiled for the instruction set already.
template <int W, int Dim, class R, class... Passes, class Weight, class Store>
[[gnu::always_inline]] inline void sweep_block(const ClusterView& list, std::size_t first,
                                               std::size_t last, const Weight& weight,
                                               const Records& records, const Store& store,
                                               const std::tuple<Passes...>& passes = {}) {
    using T = LanesOf<W>;
    using Lanes = typename R::template With<T>;
    using Sums = std::tuple<typename Passes::template Sums<T>...>;
    constexpr bool light = (is_light<Passes>() && ...);
    // On a line lists are short: the ring costs more than it saves (tests/bench/README.md).
    constexpr bool one_ahead = light || Dim == 1;
    constexpr std::size_t most = one_ahead ? 1 : most_neighbours_ahead;
    const std::size_t ahead = one_ahead ? 1 : neighbours_ahead();
    for (std::size_t cluster = first; cluster < last; ++cluster) {
        const double* const own = records.numbers + cluster * W * records.stride;
        Lanes gathered;
        gathered.visit([&](T& number, int k) {
            for (int l = 0; l < W; ++l)
                set_lane(number, l,
                         own[static_cast<std::size_t>(l) * records.stride +
                             static_cast<std::size_t>(k)]);
        });
        // Copies, here and below, of what is also taken apart lane by lane: these alone can stay in
        // registers during the loop.
        const Lanes i = gathered;
        Lanes j;
        Sums sums;
        const ClusterView::Entries entries = list.entries[cluster];
        const std::uint32_t* entry = entries.first;
        // Pairs that are begun: a ring in the nearest cache. An array for each number, of the compiler's own vectors:
        // so what no pass asks for is never stored.
        using Number = std::remove_cvref_t<decltype(bare(i.x[0]))>;
        Number r_ji[Dim][most], r2[most], r[most];
        const auto begin = [&](std::uint32_t of, std::size_t at) SPAM_FLAT {
            const double* const other = records.numbers + of;
            Vec<Dim, T> x_j;
            for (int a = 0; a < Dim; ++a) x_j[a] = T(other[a]);
            const auto apart = separation<Dim, light>(i.x, x_j);
            for (int a = 0; a < Dim; ++a) r_ji[a][at] = bare(apart.r_ji[a]);
            r2[at] = bare(apart.r2);
            r[at] = bare(apart.r);
        };
        // A pair takes several times as long, from the load of x_j to its last sum, as the multipliers work on it, and
        // the processor's queue holds few pairs: distances are found some neighbours ahead. (There are always more
        // entries than the list's.) A light pass has no time to spare for the ring: one ahead, in registers.
#pragma GCC unroll 1
        for (std::size_t k = 0; k < ahead; ++k) begin(entry[k], k);
        std::size_t at = 0;
        for (const std::uint32_t* const end = entry + entries.count; entry != end; ++entry) {
            const double* const other = records.numbers + *entry;
            j.visit([&](T& number, int k) { number = T(other[k]); });
            Separation<Dim, T> apart;
            for (int a = 0; a < Dim; ++a) apart.r_ji[a] = r_ji[a][at];
            apart.r2 = r2[at];
            apart.r = r[at];
            if constexpr (!one_ahead) __builtin_prefetch(records.numbers + entry[entries_ahead]);
            begin(entry[ahead], at);
            at = (at + 1) & (ahead - 1);
            const auto pair = make_pair<Dim, T>(weight, apart, i, j);
            std::apply([&](auto&... s) { (std::get<Passes>(passes).add(pair, i, j, s), ...); },
                       sums);
        }
        const Sums found = sums;
        std::apply([&](const auto&... s) SPAM_FLAT { store(cluster * W, gathered, s...); }, found);
    }
}

/// body(first, last) for blocks of clusters, a few hundred particles each: what one block leaves
/// behind for the next thing done with its particles still fits into the nearest cache.
inline constexpr std::size_t clusters_per_block = 32;
template <int W, class Body>
void for_each_block(const ClusterView& list, const Body& body) {
    constexpr std::size_t size = clusters_per_block;
    parallel_for((list.clusters + size - 1) / size,
                 [&](std::size_t b) { body(b * size, std::min(list.clusters, (b + 1) * size)); },
                 size * W);
}

/// A sweep over all clusters.
template <int W, int Dim, class R, class... Passes, class Weight, class Store>
void sweep(const ClusterView& list, const Weight& weight, const Records& records,
           const Store& store, const std::tuple<Passes...>& passes = {}) {
    for_each_block<W>(list, [&](std::size_t first, std::size_t last) {
        sweep_block<W, Dim, R, Passes...>(list, first, last, weight, records, store, passes);
    });
}

/// f(lane, particle) for the particles of the cluster that begins at `first_slot`.
template <int W, class F>
SPAM_INLINE void for_each_lane(const ClusterView& list, std::size_t first_slot, const F& f) {
    const std::uint32_t* const particle = list.order + first_slot;
    if (first_slot + W <= list.particles) {
        for (int l = 0; l < W; ++l) f(l, std::size_t{particle[l]});
    } else {
        for (int l = 0; first_slot + static_cast<std::size_t>(l) < list.particles; ++l)
            f(l, std::size_t{particle[l]});
    }
}

}  // namespace SPAM_LANES
}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/lanes.hpp>
#include <spam/core/parallel.hpp>
#include <spam/neighbors/cluster_view.hpp>
#include <spam/neighbors/pair.hpp>

#include <algorithm>
#include <tuple>

namespace spam {
inline namespace SPAM_LANES {

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
        const auto distance_to = [&](const double* other) {
            Vec<Dim, T> x_j;
            for (int a = 0; a < Dim; ++a) x_j[a] = T(other[a]);
            return separation<Dim, light>(i.x, x_j);
        };
        const double* other = records.numbers + *entry;
        auto apart = distance_to(other);
        for (const std::uint32_t* const end = entry + entries.count; entry != end; ++entry) {
            // What waits for a square root would fill the processor's queue before the next one is
            // begun: it is begun here. (There is always one entry more than the list's.)
            const double* const next = records.numbers + entry[1];
            const auto next_apart = distance_to(next);
            j.visit([&](T& number, int k) { number = T(other[k]); });
            const auto pair = make_pair<Dim, T>(weight, apart, i, j);
            std::apply([&](auto&... s) { (std::get<Passes>(passes).add(pair, i, j, s), ...); },
                       sums);
            other = next;
            apart = next_apart;
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parallel.hpp>
#include <spam/core/vec.hpp>
#include <spam/kernel/weight_function.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <span>
#include <tuple>

namespace spam {

/// What every pair body sees of a pair: i minus j.
template <int Dim, class T>
struct Pair {
    Vec<Dim, T> r_ij;
    T r2;
    T w_ij;
    Vec<Dim, T> grad_w_ij;  ///< gradient at i: (w'/r) r_ij
    Vec<Dim, T> v_ij;
};

/// Everything a pair body may ask of a pair, from two records that hold at least x and v.
/// Exactly antisymmetric: exchanging i and j flips the sign of r_ij, grad_w_ij, v_ij bit for bit.
template <int Dim, class T, class Weight, class Record>
Pair<Dim, T> make_pair(const Weight& weight, const Box<Dim>& box, const Record& i,
                       const Record& j) {
    using std::sqrt;
    Pair<Dim, T> pair;
    for (int a = 0; a < Dim; ++a) pair.r_ij[a] = box.nearest_image(a, i.x[a] - j.x[a]);
    pair.r2 = dot(pair.r_ij, pair.r_ij);
    const T r = sqrt(pair.r2);
    pair.w_ij = weight.value(r);
    pair.grad_w_ij = weight.slope_over_r(r) * pair.r_ij;
    pair.v_ij = i.v - j.v;
    return pair;
}

/// One sweep over all pairs for one or more passes that need nothing from each other, gather form:
/// for each particle i the sums of every pass over its neighbours (itself included), then
/// store(i, sums...). A pass is a plain type with
///     template <class T> struct Sums;
///     template <class T, class Record> static void add(pair, i, j, Sums<T>&);
template <int Dim, class... Passes, class Weight, class Record, class Store>
void sweep(const PairList<Dim>& list, const Weight& weight, std::span<const Record> records,
           const Store& store) {
    // flatten: pair bodies are many small functions; a call per pair would cost more than its sums.
    parallel_for(
        list.size(), [&](std::size_t i) __attribute__((flatten)) {
            std::tuple<typename Passes::template Sums<double>...> sums;
            for (const std::uint32_t j : list.neighbours(i)) {
                const auto pair =
                    make_pair<Dim, double>(weight, list.box(), records[i], records[j]);
                std::apply([&](auto&... s) { (Passes::add(pair, records[i], records[j], s), ...); },
                           sums);
            }
            std::apply([&](const auto&... s) { store(i, s...); }, sums);
        });
}

}  // namespace spam

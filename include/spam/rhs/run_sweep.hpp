// SPDX-License-Identifier: GPL-3.0-or-later
// For *.lanes.cpp: how passes over pairs become a function that a term of a model calls.
#pragma once

#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/sweep.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/sweeps.hpp>

#include <cstddef>

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

/// Any weight function, compiled once: nearest images are always looked for. In open space the box
/// subtracts zeros.
struct GeneralSweep {
    template <int W, int Dim, class R, class... Passes, class Store>
    static void run(const SweepInput<Dim>& in, std::size_t begin, std::size_t end,
                    const Store& store, const std::tuple<Passes...>& passes) {
        sweep_run<W, Dim, R>(in, begin, end, *in.weight, *in.box, store, passes);
    }
};

/// Where a pass stores what it has found for one particle: `out.FIELD` of that particle, or its record.
template <int Dim>
struct Lane {
    const SweepOutput<Dim>& out;
    double* record;
    std::size_t particle;
    int lane_number;

    template <class Value>
    SPAM_INLINE void set(double* field, const Value& value) const {
        if (field == nullptr) return;
        double* to = at<Value>(field);
        for_each_number(value, [&](const auto& n) { *to++ = lane(n, lane_number); });
    }
    /// v_dot, on top of what other terms have given.
    template <class Value>
    SPAM_INLINE void accelerate(const Value& v_dot) const {
        out.on_top ? add(out.v_dot, v_dot) : set(out.v_dot, v_dot);
    }
    template <class Value>
    SPAM_INLINE void add(double* field, const Value& value) const {
        double* to = at<Value>(field);
        for_each_number(value, [&](const auto& n) { *to++ += lane(n, lane_number); });
    }
    /// A column of the record, which may lie behind those that the sweep reads.
    template <class R, class Column, class Value>
    SPAM_INLINE void write(const Value& value) const {
        double* to = record + R::template at<Column>;
        for_each_number(value, [&](const auto& n) { *to++ = lane(n, lane_number); });
    }

  private:
    template <class Value>
    SPAM_INLINE double* at(double* field) const {
        std::size_t numbers = 0;
        Value value;
        for_each_number(value, [&](const auto&) { ++numbers; });
        return field + particle * numbers;
    }
};

/// The pass with its constants, where it has any.
template <class Pass, int Dim>
Pass pass_of(const SweepInput<Dim>& in) {
    if constexpr (requires { Pass::with(in.constants, *in.weight); })
        return Pass::with(in.constants, *in.weight);
    else if constexpr (requires { Pass::with(in.constants); })
        return Pass::with(in.constants);
    else
        return {};
}

/// The sums of passes that name a type `Kept`, for one block, by slot; nothing for other passes.
template <class Pass, int W>
struct KeptSums {
    template <class Result>
    SPAM_INLINE void keep(std::size_t, const Result&) {}
    SPAM_INLINE void list(const void**&) const {}
};
template <class Pass, int W>
requires requires { typename Pass::Kept; }
struct KeptSums<Pass, W> {
    using Kept = typename Pass::Kept;
    // Bytes, because there is no need for zeros.
    alignas(64) std::byte memory[clusters_per_block * W * sizeof(Kept)];

    template <class Result>
    SPAM_INLINE void keep(std::size_t slot, const Result& result) {
        auto* const to = reinterpret_cast<Kept*>(memory) + slot;
        std::size_t k = 0;
        for_each_number(result, [&](const auto& number) {
            for (int l = 0; l < W; ++l) to[l].c[k] = lane(number, l);
            ++k;
        });
    }
    SPAM_INLINE void list(const void**& next) const { *next++ = memory; }
};

/// One sweep over all pairs. `Kind`: LucysSweep or GeneralSweep. R: the record that is read. A pass is as
/// sweep.hpp describes it, and besides has (all but the last may be left out)
///     static Pass with(const PassConstants&[, const GeneralWeight<Dim>&]);
///     template <class T, class R> ... result(const R& i, const Sums<T>&);   of the finished sums
///     using Kept = ...;           what result() is with T = double: kept for `close`, not stored
///     template <class To, class Result> static void store(const To&, const Result&);
/// Sums are stored particle by particle, in the order of the passes: a pass may add to what one before it
/// has set.
template <class Kind, int W, int Dim, class R, class... Passes>
void run_sweep(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    const std::tuple<Passes...> passes{pass_of<Passes>(in)...};
    const auto finish = [](const auto& pass, const auto& i, const auto& sums) {
        if constexpr (requires { pass.result(i, sums); })
            return pass.result(i, sums);
        else
            return sums;
    };
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        std::tuple<KeptSums<Passes, W>...> kept;
        Kind::template run<W, Dim, R>(
            in, begin, end,
            [&](std::size_t slot, const auto& i, const auto&... sums) {
                const std::tuple found{finish(std::get<Passes>(passes), i, sums)...};
                const auto each = [&]<std::size_t... K>(std::index_sequence<K...>) {
                    (std::get<K>(kept).keep(slot - begin * W, std::get<K>(found)), ...);
                    for_each_lane<W>(in.list, slot, [&](int l, std::size_t particle) {
                        const Lane<Dim> to{
                            out,
                            out.records + (slot + static_cast<std::size_t>(l)) * in.records.stride,
                            particle, l};
                        const auto store = [&]<class Pass>(const Pass&, const auto& result) {
                            if constexpr (!requires { typename Pass::Kept; })
                                Pass::store(to, result);
                        };
                        (store(std::get<K>(passes), std::get<K>(found)), ...);
                    });
                };
                each(std::index_sequence_for<Passes...>());
            },
            passes);
        if (out.close == nullptr) return;
        SweptBlock block{begin * W,
                         in.list.order + begin * W,
                         std::min(end * W, in.list.particles) - begin * W,
                         {nullptr, nullptr}};
        const void** next = block.kept;
        std::apply([&](const auto&... k) { (k.list(next), ...); }, kept);
        out.close(out.context, block);
    });
}

}  // namespace SPAM_LANES
}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// For *.lanes.cpp: how passes over pairs become a function that a term of a model calls.
#pragma once

#include <spam/kernel/lucy.hpp>
#include <spam/neighbors/sweep.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/pack.hpp>
#include <spam/rhs/sweeps.hpp>

#include <cstddef>

namespace spam {
inline namespace SPAM_LANES {

/// Kinds of sweeps, by their weight function.
struct LucysSweep {};
struct GeneralSweep {};

/// sweep_block() in a function of its own: the loop has the registers to itself, and is compiled once
/// wherever it is called from.
template <int W, int Dim, class R, class... Passes, class Weight, class Store>
[[gnu::flatten, gnu::noinline]] void sweep_run(const SweepInput<Dim>& in, std::size_t begin,
                                               std::size_t end, const Weight& weight,
                                               const Store& store_sums,
                                               const std::tuple<Passes...>& passes) {
    // Copies, which nothing outside can change: they save instructions in the loop.
    const Weight own = weight;
    const ClusterView list = in.list;
    const Records records = in.records;
    sweep_block<W, Dim, R, Passes...>(list, begin, end, own, records, store_sums, passes);
}

/// Lucy's own formula.
template <int Dim>
Lucy<Dim> weight_of(const SweepInput<Dim>& in, LucysSweep) {
    return Lucy<Dim>(in.range);
}
/// Any weight function, compiled once.
template <int Dim>
const GeneralWeight<Dim>& weight_of(const SweepInput<Dim>& in, GeneralSweep) {
    return *in.weight;
}

/// Where a pass stores what it has found for one particle: `out.FIELD` of that particle, or its record.
template <int W, int Dim>
struct Lane {
    const SweepOutput<Dim>& out;
    std::size_t record;  ///< where it begins among out.records
    std::size_t particle;
    int lane_number;  ///< of W

    template <class Value>
    SPAM_INLINE void set(double* field, const Value& value) const {
        double* to = at<Value>(field);
        for_each_number(value, [&](const auto& n) SPAM_FLAT { *to++ = lane(n, lane_number); });
    }
    template <class Value>
    SPAM_INLINE void add(double* field, const Value& value) const {
        double* to = at<Value>(field);
        for_each_number(value, [&](const auto& n) SPAM_FLAT { *to++ += lane(n, lane_number); });
    }
    /// A column of the record, behind those that the sweep reads: of neighbours it may be read at any time.
    template <class R, template <int, class> class Column, class Value>
    SPAM_INLINE void write(const Value& value) const {
        double* to = out.records + record + R::template at<Column>;
        for_each_number(value, [&](const auto& n) SPAM_FLAT { *to++ = lane(n, lane_number); });
    }
    template <class R, template <int, class> class Column, class Value>
    SPAM_INLINE void write_more(const Value& value) const {
        double* to = out.records + record + R::template at<Column>;
        for_each_number(value, [&](const auto& n) SPAM_FLAT { *to++ += lane(n, lane_number); });
    }

  private:
    /// sizeof counts the numbers of a tuple as well.
    template <class Value>
    SPAM_INLINE double* at(double* field) const {
        return field + particle * (sizeof(Value) / sizeof(LanesOf<W>));
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
    // Bytes, because there is no need for zeros; and a constructor, because a tuple would write them.
    alignas(64) std::byte memory[clusters_per_block * W * sizeof(Kept)];
    KeptSums() {}

    template <class Result>
    SPAM_INLINE void keep(std::size_t slot, const Result& result) {
        auto* const to = reinterpret_cast<Kept*>(memory) + slot;
        std::size_t k = 0;
        for_each_number(result, [&](const auto& number) SPAM_FLAT {
            for (int l = 0; l < W; ++l) to[l].c[k] = lane(number, l);
            ++k;
        });
    }
    SPAM_INLINE void list(const void**& next) const { *next++ = memory; }
};

/// What happens to the sums of one cluster of W particles: kept for the block, or stored.
template <int W, int Dim, class... Passes>
struct StoreSums {
    using Kept = std::tuple<KeptSums<Passes, W>...>;

    const SweepInput<Dim>& in;
    const SweepOutput<Dim>& out;
    const std::tuple<Passes...>& passes;
    std::size_t block;  ///< its first slot
    Kept& kept;

    template <class R, class... Sums>
    SPAM_INLINE void operator()(std::size_t slot, const R& i, const Sums&... sums) const {
        each(slot, i, std::index_sequence_for<Passes...>(), sums...);
    }

  private:
    template <class R, std::size_t... K, class... Sums>
    SPAM_INLINE void each(std::size_t slot, const R& i, std::index_sequence<K...>,
                          const Sums&... sums) const {
        (std::get<K>(kept).keep(slot - block, result(std::get<K>(passes), i, sums)), ...);
        for_each_lane<W>(in.list, slot, [&](int l, std::size_t particle) SPAM_FLAT {
            const Lane<W, Dim> to{out, (slot + static_cast<std::size_t>(l)) * in.records.stride,
                                  particle, l};
            (store(std::get<K>(passes), to, result(std::get<K>(passes), i, sums)), ...);
        });
    }
    template <class Pass, class R, class Sums>
    SPAM_INLINE static auto result(const Pass& pass, const R& i, const Sums& sums) {
        if constexpr (requires { pass.result(i, sums); })
            return pass.result(i, sums);
        else
            return sums;
    }
    template <class Pass, class Result>
    SPAM_INLINE static void store(const Pass& pass, const Lane<W, Dim>& to, const Result& found) {
        if constexpr (requires { Pass::sets(to.out); })
            to.set(Pass::sets(to.out), found);
        else if constexpr (requires { pass.store(to, found); })
            pass.store(to, found);
        else if constexpr (!requires { typename Pass::Kept; })
            found.store(to);
    }
};

/// One sweep over all pairs. `Kind`: LucysSweep or GeneralSweep. R: the record that is read. A pass is as
/// sweep.hpp describes it, and besides has (all but the last may be left out)
///     static Pass with(const PassConstants&[, const GeneralWeight<Dim>&]);
///     template <class T, class R> ... result(const R& i, const Sums<T>&);   of the finished sums
///     using Kept = ...;           what result() is with T = double: kept for `close`, not stored
///     static double* sets(const auto& out) { return out.v_dot; }   where result() is stored, or
///     template <class To, class Result> static void store(const To&, const Result&);   what is, or neither where
///     what result() returns has a store(to) of its own, as ForceSums
/// Sums are stored particle by particle, in the order of the passes: a pass may add to what one before it
/// has set.
template <class Kind, int W, int Dim, class R, class... Passes>
void run_sweep(const SweepInput<Dim>& in, const SweepOutput<Dim>& out) {
    const std::tuple<Passes...> passes{pass_of<Passes>(in)...};
    using Store = StoreSums<W, Dim, Passes...>;
    for_each_block<W>(in.list, [&](std::size_t begin, std::size_t end) {
        typename Store::Kept kept;
        sweep_run<W, Dim, R>(in, begin, end, weight_of(in, Kind{}),
                             Store{in, out, passes, begin * W, kept}, passes);
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

/// The sweeps of a law of pairs (pair_term.hpp): passes `Force`, which stores v_dot (and e_dot of friction), and
/// `Energy`, which stores half of each pair's energy; without where there is none. R: PointRecord or, for what depends
/// on velocities, MotionRecord, and what the law needs behind it.
template <InstructionSet Level, class Kind, int Dim, class R, class Force, class... Energy>
Sweeps<Dim> pair_sweeps() {
    constexpr int W = native_lanes(Level);
    Sweeps<Dim> sweeps{W, R::numbers, pack<Dim, PointRecord<Dim>>};
    if constexpr (R::template has<column::Velocity>) sweeps.pack = pack<Dim, MotionRecord<Dim>>;
    sweeps.force = run_sweep<Kind, W, Dim, R, Force>;
    ((sweeps.energy = run_sweep<Kind, W, Dim, R, Energy>), ...);
    return sweeps;
}

}  // namespace SPAM_LANES
}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parallel.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <tuple>
#include <vector>

namespace spam {

/// The sum of any numbers: exact, and rounded once to the nearest double where it is asked for. So it has the
/// same bits in any order of the terms, with any number of threads, and however they are parted: sums over
/// particles are taken with it alone. An infinity or a NaN among the terms makes the sum what IEEE addition
/// would. Terms may cancel down to their last bit: what is left is right to half a unit in the last place.
///
/// It is a number of fixed point with enough digits for all doubles (a superaccumulator: R. M. Neal, Fast exact
/// summation using small and large superaccumulators, arXiv:1505.05571). One digit has 40 bits, and the rest of a
/// 64-bit word keeps carries, which move up later. Blocks of terms are split into digits in the processor's vector
/// registers, which takes about a nanosecond a term.
class ExactSum {
  public:
    /// The largest number of terms that add_block() takes.
    static constexpr std::size_t block = 256;
    using Block = std::array<double, block>;

    ExactSum& operator+=(double x);
    ExactSum& operator+=(const ExactSum& other);

    /// Adds the first `count` numbers. The block's contents are lost.
    void add_block(Block& terms, std::size_t count);

    /// The sum, rounded to nearest.
    double value() const;
    operator double() const { return value(); }

  private:
    // Digit d counts multiples of 2^(40 d - 1074); d = 0: of the smallest double. Doubles reach to digit 52, and two
    // digits more are for carries.
    static constexpr std::size_t digits = 55;
    // A term adds less than 2^40 to a digit: so many fit into a word of 64 bits.
    static constexpr std::int32_t most_uncarried = 1 << 22;

    void carry();

    std::array<std::int64_t, digits> digit_{};
    std::int32_t uncarried_ = 0;
    double not_finite_ = 0.0;  ///< the sum of infinite terms and NaN
};

/// Adds to each sum those that the other parts of the run have found (core/parts.hpp).
void add_other_parts(std::span<ExactSum> sums);

/// K sums over 0, ..., n - 1 at once, and of all parts of the run. fill(first, count, rows) writes what first, ...,
/// first + count - 1 add to sum k to rows[k][0], ..., rows[k][count - 1], or returns false where they add nothing;
/// from so many on several threads call it, for other blocks each.
template <std::size_t K, class Fill>
std::array<double, K> exact_sums_of_blocks(std::size_t n, const Fill& fill,
                                           std::size_t threads_from = parallel_threshold) {
    constexpr std::size_t block = ExactSum::block;
    std::array<ExactSum, K> sums;
    const auto add = [&](std::size_t b, std::array<ExactSum, K>& to) {
        alignas(64) std::array<ExactSum::Block, K> rows;
        const std::size_t first = b * block, count = std::min(block, n - first);
        if (!fill(first, count, rows)) return;
        for (std::size_t k = 0; k < K; ++k) to[k].add_block(rows[k], count);
    };
    const std::size_t blocks = (n + block - 1) / block;
    if (n < threads_from) {
        for (std::size_t b = 0; b < blocks; ++b) add(b, sums);
    } else {
        std::mutex one_at_a_time;
        parallel_ranges(
            blocks,
            [&](std::size_t from, std::size_t to) {
                std::array<ExactSum, K> of_range;
                for (std::size_t b = from; b < to; ++b) add(b, of_range);
                const std::lock_guard lock(one_at_a_time);
                for (std::size_t k = 0; k < K; ++k) sums[k] += of_range[k];
            },
            block);
    }
    add_other_parts(sums);
    std::array<double, K> values;
    for (std::size_t k = 0; k < K; ++k) values[k] = sums[k];
    return values;
}

/// K sums over 0, ..., n - 1 at once; terms(i), a std::array<double, K>, is what i adds to each.
template <class Terms>
auto exact_sums(std::size_t n, const Terms& terms) {
    constexpr std::size_t K = std::tuple_size_v<decltype(terms(std::size_t{}))>;
    return exact_sums_of_blocks<K>(
        n, [&](std::size_t first, std::size_t count, std::array<ExactSum::Block, K>& rows) {
            for (std::size_t i = 0; i < count; ++i) {
                const std::array<double, K> of_i = terms(first + i);
                for (std::size_t k = 0; k < K; ++k) rows[k][i] = of_i[k];
            }
            return true;
        });
}

/// The sum of term(i) over 0, ..., n - 1.
template <class Term>
double exact_sum(std::size_t n, const Term& term) {
    return exact_sums(n, [&](std::size_t i) { return std::array<double, 1>{term(i)}; })[0];
}

/// K sums over each of some groups, bodies for example. Where there are several it works on one thread.
template <std::size_t K>
class ExactGroupSums {
  public:
    /// By group, until the next call. group[i]: 0, ..., groups - 1; terms(i): what i adds to those of its group.
    template <class Terms>
    std::span<const std::array<double, K>> of(std::span<const std::int32_t> group,
                                              std::size_t groups, const Terms& terms) {
        values_.resize(groups);
        if (groups == 1) {
            values_[0] = exact_sums(group.size(), terms);
            return values_;
        }
        sums_.assign(groups, {});
        for (std::size_t i = 0; i < group.size(); ++i) {
            const std::array<double, K> of_i = terms(i);
            for (std::size_t k = 0; k < K; ++k)
                sums_[static_cast<std::size_t>(group[i])][k] += of_i[k];
        }
        for (auto& of_group : sums_) add_other_parts(of_group);
        for (std::size_t g = 0; g < groups; ++g)
            std::copy(sums_[g].begin(), sums_[g].end(), values_[g].begin());
        return values_;
    }

  private:
    std::vector<std::array<ExactSum, K>> sums_;
    std::vector<std::array<double, K>> values_;
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_sum_digits.hpp"
#include "levels.hpp"
#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>

#include <bit>
#include <cmath>
#include <limits>

namespace spam {
namespace {

constexpr std::int64_t digit_mask = (std::int64_t{1} << digit_bits) - 1;

/// The numbers of a block that is no multiple of what the registers hold are followed by zeros.
constexpr std::size_t filled(std::size_t count) { return (count + 15) / 16 * 16; }

/// Every digit but the last from 0 to 2^40 - 1.
void carry_up(std::span<std::int64_t> digit) {
    for (std::size_t d = 0; d + 1 < digit.size(); ++d) {
        const std::int64_t carried = digit[d] >> digit_bits;
        digit[d] &= digit_mask;
        digit[d + 1] += carried;
    }
}

}  // namespace

/// The 53 bits of x, which begin anywhere in a digit, lie in three at the most.
ExactSum& ExactSum::operator+=(double x) {
    if (!std::isfinite(x)) {
        not_finite_ += x;
        return *this;
    }
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const int biased = static_cast<int>(bits >> 52 & 0x7ff);
    const int place =
        biased > 0 ? biased - 1 : 0;  // of the last bit, above that of the smallest number
    std::int64_t number = static_cast<std::int64_t>(bits & ((std::uint64_t{1} << 52) - 1));
    if (biased > 0) number |= std::int64_t{1} << 52;
    const int shift = place % digit_bits, sign = x < 0.0 ? -1 : 1;
    std::int64_t* const at = digit_.data() + place / digit_bits;
    const std::int64_t first = number & (digit_mask >> shift);
    number >>= digit_bits - shift;
    at[0] += sign * (first << shift);
    at[1] += sign * (number & digit_mask);
    at[2] += sign * (number >> digit_bits);
    if (++uncarried_ == most_uncarried) carry();
    return *this;
}

ExactSum& ExactSum::operator+=(const ExactSum& other) {
    ExactSum carried = other;
    carried.carry();
    for (std::size_t d = 0; d < digits; ++d) digit_[d] += carried.digit_[d];
    not_finite_ += other.not_finite_;
    if (++uncarried_ == most_uncarried) carry();
    return *this;
}

void ExactSum::add_block(Block& terms, std::size_t count) {
    std::fill(terms.begin() + static_cast<std::ptrdiff_t>(count),
              terms.begin() + static_cast<std::ptrdiff_t>(filled(count)), 0.0);
    static const auto add =
        at_level(instruction_set(), [](auto level) { return &add_digits<level()>; });
    if (add(terms.data(), filled(count), digit_.data())) return;
    for (std::size_t k = 0; k < count; ++k) *this += terms[k];
}

void ExactSum::carry() {
    carry_up(digit_);
    uncarried_ = 0;
}

void add_other_parts(std::span<ExactSum> sums) {
    Parts& parts = Parts::here();
    if (parts.alone()) return;
    const auto all = parts.gather(std::span<const ExactSum>(sums), Parts::Content::sums);
    for (std::size_t k = 0; k < sums.size(); ++k) {
        sums[k] = {};
        for (const auto& of_part : all) sums[k] += of_part[k];
    }
}

double ExactSum::value() const {
    if (not_finite_ != 0.0) return not_finite_;  // NaN, too
    // Terms of one size fill a few digits. Those above and below are 0, but for what is carried into one above: a
    // word of 64 bits is less than two digits.
    std::size_t first = 0, end = digits;
    while (first < digits && digit_[first] == 0) ++first;
    if (first == digits) return 0.0;
    while (digit_[end - 1] == 0) --end;
    std::array<std::int64_t, digits> room{};
    const std::span sum(room.data(), std::min(end + 1, digits) - first);
    std::copy_n(digit_.begin() + static_cast<std::ptrdiff_t>(first), sum.size(), sum.begin());
    carry_up(sum);
    const bool negative = sum.back() < 0;
    if (negative) {
        for (std::int64_t& digit : sum) digit = -digit;
        carry_up(sum);
    }
    std::size_t top = sum.size() - 1;
    while (top > 0 && sum[top] == 0) --top;
    const auto digit = [&](std::size_t below) {
        return below <= top ? static_cast<std::uint64_t>(sum[top - below]) : 0;
    };
    if (digit(0) == 0) return 0.0;
    // The first 64 bits, of three digits at the most. Of those below only counts whether all are 0.
    constexpr auto mask = static_cast<std::uint64_t>(digit_mask);
    const int space = std::countl_zero(digit(0));
    std::uint64_t high = digit(0) << space, rest = 0;
    if (space <= digit_bits) {
        high |= digit(1) >> (digit_bits - space);
        rest = (digit(1) & (mask >> space)) | digit(2);
    } else {
        const int of_last = space - digit_bits;
        high |= digit(1) << of_last | digit(2) >> (digit_bits - of_last);
        rest = digit(2) & (mask >> of_last);
    }
    for (std::size_t below = 3; below <= top; ++below) rest |= digit(below);
    if (rest != 0) high |= 1;
    const double size =
        std::ldexp(static_cast<double>(high),
                   lowest_exponent + digit_bits * static_cast<int>(first + top) - space);
    return negative ? -size : size;
}

}  // namespace spam

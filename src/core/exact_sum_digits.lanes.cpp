// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_sum_digits.hpp"

#include <spam/core/lanes.hpp>

#include <algorithm>
#include <bit>
#include <limits>

namespace spam {
namespace {

constexpr int width = native_lanes(InstructionSet::SPAM_LEVEL);
using Register = Lanes<width>;

Register magnitude(const Register& x) { return max(x, -x); }

/// The largest lane, NaN if the last is one.
double largest_of(const Register& x) {
    double largest = lane(x, 0);
    for (int l = 1; l < width; ++l) largest = std::max(largest, lane(x, l));
    return largest;
}
double sum_of(const Register& x) {
    double sum = 0.0;
    for (int l = 0; l < width; ++l) sum += lane(x, l);
    return sum;
}

/// The largest |x|; NaN where a number is infinite or NaN.
double largest_magnitude(const double* x, std::size_t count) {
    Register largest, zero;
    for (std::size_t k = 0; k < count; k += width) {
        const Register x_k = load_lanes<width>(x + k);
        largest = max(magnitude(x_k), largest);
        zero += x_k * Register(0.0);
    }
    return largest_of(largest) + sum_of(zero);
}

/// 1.5 x 2^52 units of a digit: added and subtracted again, it rounds what is below 2^51 units to whole ones.
double rounder(int digit) {
    const int exponent = lowest_exponent + digit_bits * digit + 52;
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52 |
                                 std::uint64_t{1} << 51);
}

/// Of a number >= 0, which is below 2^this.
int exponent_above(double x) {
    return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52) - 1022;
}

/// Takes from every number its nearest multiple of the digit's unit and leaves the rest, at most half a unit. Sums of
/// the multiples are exact: 256 of at most 2^39 units.
struct Split {
    std::int64_t units;
    double largest_rest;
};
Split split(double* x, std::size_t count, int digit) {
    constexpr int ways = 2;  // so that no register waits for the one before
    const double round = rounder(digit);
    const Register rounds(round);
    Register sum[ways], largest[ways];
    for (std::size_t k = 0; k < count; k += ways * width)
        for (int w = 0; w < ways; ++w) {
            double* const at = x + k + static_cast<std::size_t>(w * width);
            const Register x_k = load_lanes<width>(at), multiple = (x_k + rounds) - rounds;
            const Register rest = x_k - multiple;
            sum[w] += multiple;
            largest[w] = max(magnitude(rest), largest[w]);
            store_lanes(at, rest);
        }
    // The last bits of a number between 2^52 and 2^53 units count units.
    const double shifted = sum_of(sum[0] + sum[1]) + round;
    return {std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(round),
            largest_of(max(largest[0], largest[1]))};
}

}  // namespace

template <InstructionSet Level>
bool add_digits(double* x, std::size_t count, std::int64_t* digit) {
    double largest = largest_magnitude(x, count);
    if (!(largest < 0x1p1000)) return false;
    // From the highest digit with all terms below 2^39 of its units down, until no rest is left. Digits without
    // anything are passed over.
    for (int below = std::numeric_limits<int>::max(); largest > 0.0;) {
        const int d = std::min(below - 1, (exponent_above(largest) - lowest_exponent) / digit_bits);
        const Split of_x = split(x, count, d);
        digit[d] += of_x.units;
        const std::int64_t carried = digit[d] >> digit_bits;
        digit[d] -= carried << digit_bits;
        digit[d + 1] += carried;
        largest = of_x.largest_rest;
        below = d;
    }
    return true;
}

template bool add_digits<InstructionSet::SPAM_LEVEL>(double*, std::size_t, std::int64_t*);

}  // namespace spam

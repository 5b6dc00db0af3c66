// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>

#include <cstddef>
#include <cstdint>

namespace spam {

/// Of ExactSum: digit d counts multiples of 2^(40 d - 1074).
inline constexpr int digit_bits = 40, lowest_exponent = -1074;

/// Adds the numbers x to the digits and carries; x is lost. False, with x and the digits as they were, where a
/// number is infinite, NaN or above 2^1000. `count`: a multiple of 16, at most ExactSum::block.
template <InstructionSet Level>
bool add_digits(double* x, std::size_t count, std::int64_t* digit);

}  // namespace spam

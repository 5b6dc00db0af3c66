// SPDX-License-Identifier: GPL-3.0-or-later
#include "candidates.hpp"

#include <array>
#include <utility>

namespace spam {
namespace {

constexpr int digit_bits = 8;
constexpr std::uint64_t digit_mask = (1U << digit_bits) - 1;

}  // namespace

/// One pass of a radix sort: std::sort guesses wrong at every other comparison, which made building
/// the list of a gas cost five right-hand sides.
void Candidates::sort_digit(int shift) {
    std::array<std::uint32_t, digit_mask + 1> start{};
    for (const std::uint64_t key : keys_) ++start[(key >> shift) & digit_mask];
    std::uint32_t sum = 0;
    for (std::uint32_t& count : start) sum += std::exchange(count, sum);
    for (const std::uint64_t key : keys_) spare_[start[(key >> shift) & digit_mask]++] = key;
    keys_.swap(spare_);
}

void Candidates::sort(const std::uint32_t* number) {
    keys_.resize(slots_.size());
    spare_.resize(slots_.size());
    std::uint64_t last = 0, differing = 0;
    bool sorted = true;
    for (std::size_t k = 0; k < slots_.size(); ++k) {
        keys_[k] = std::uint64_t{number[slots_[k]]} << 32 | slots_[k];
        sorted = sorted && last <= keys_[k];
        differing |= keys_[k] ^ keys_[0];
        last = keys_[k];
    }
    if (sorted) return;
    for (int shift = 32; shift < 64; shift += digit_bits)
        if ((differing >> shift & digit_mask) != 0) sort_digit(shift);
    for (std::size_t k = 0; k < slots_.size(); ++k)
        slots_[k] = static_cast<std::uint32_t>(keys_[k]);
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/cluster_view.hpp>

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace spam {

/// Slots that a search looks through, put in ascending number of their particle. One for each thread,
/// used again and again.
class Candidates {
  public:
    void clear() { slots_.clear(); }
    void add(std::size_t first, std::size_t last) {
        const std::size_t begin = slots_.size();
        slots_.resize(begin + (last - first));
        std::iota(slots_.begin() + static_cast<std::ptrdiff_t>(begin), slots_.end(),
                  static_cast<std::uint32_t>(first));
    }
    /// `number`: slot -> particle.
    void sort(const std::uint32_t* number);

    std::span<const std::uint32_t> slots() const { return slots_; }

  private:
    void sort_digit(int shift);

    std::vector<std::uint32_t> slots_;
    std::vector<std::uint64_t> keys_, spare_;  ///< number of the particle, then its slot
};

}  // namespace spam

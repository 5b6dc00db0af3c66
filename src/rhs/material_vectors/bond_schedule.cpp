// SPDX-License-Identifier: GPL-3.0-or-later
#include "bond_schedule.hpp"

#include <algorithm>

namespace spam {

BondSchedule::BondSchedule(std::span<const Reach> reach, std::size_t threads)
    : threads_(std::max<std::size_t>(1, std::min(reach.size(), threads))),
      room_(reach.size()) {
    order(reach);
    assign_rooms(reach);
}

void BondSchedule::order(std::span<const Reach> reach) {
    given_until_.assign(reach.size() + 1, 0);
    for (std::size_t thread = 0; thread < threads_; ++thread) {
        std::size_t next = begin(thread);
        for (std::size_t b = begin(thread); b < end(thread); ++b) {
            for (; next <= b; ++next) {
                const auto one = static_cast<std::uint32_t>(next);
                if (reach[next].elsewhere || reach[next].first < begin(thread) ||
                    reach[next].last >= end(thread))
                    last_.push_back(one);
                else if (reach[next].last <= b)
                    given_.push_back(one);
                else
                    break;
            }
            given_until_[b + 1] = given_.size();
        }
    }
}

/// The room of a block is free when the last block has been given that wants what is in it.
void BondSchedule::assign_rooms(std::span<const Reach> reach) {
    const std::size_t blocks = reach.size(), never = blocks;
    std::vector<std::size_t> used_until(blocks);
    for (std::size_t b = 0; b < blocks; ++b) {
        used_until[b] = std::max(used_until[b], b);
        for (const std::uint32_t given : after(b))
            for (std::size_t c = reach[given].first; c <= reach[given].last; ++c)
                used_until[c] = std::max(used_until[c], b);
    }
    for (const std::uint32_t given : last_)
        for (std::size_t c = reach[given].first; c <= reach[given].last; ++c) used_until[c] = never;

    std::vector<std::vector<std::size_t>> free_after(blocks);
    for (std::size_t b = 0; b < blocks; ++b)
        if (used_until[b] != never) free_after[used_until[b]].push_back(b);
    rooms_ = 0;
    for (std::size_t thread = 0; thread < threads_; ++thread) {
        std::vector<std::uint32_t> free;
        for (std::size_t b = begin(thread); b < end(thread); ++b) {
            if (free.empty()) {
                room_[b] = static_cast<std::uint32_t>(rooms_++);
            } else {
                room_[b] = free.back();
                free.pop_back();
            }
            for (const std::size_t done : free_after[b]) free.push_back(room_[done]);
        }
    }
}

}  // namespace spam

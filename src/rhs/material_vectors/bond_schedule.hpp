// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spam {

/// In which order threads sum blocks of particles over their bonds, and where in memory what a block finds of them
/// is kept meanwhile. A block is found first, and given back what its partners have found as soon as all of these
/// are there; then the room of those that no block waits for any more is used again, so that what is found stays in
/// the cache. Every thread has blocks that follow each other; a block with partners among those of another thread is
/// given last, when all are found; likewise one with partners in other parts of the run. No sum depends on it.
class BondSchedule {
  public:
    /// The first and the last block that a block has bonds with.
    struct Reach {
        std::size_t first, last;
        bool elsewhere = false;  ///< and with particles of other parts
    };

    BondSchedule() = default;
    BondSchedule(std::span<const Reach> reach, std::size_t threads);

    std::size_t threads() const { return threads_; }
    /// Blocks [begin, end) of a thread.
    std::size_t begin(std::size_t thread) const { return thread * room_.size() / threads_; }
    std::size_t end(std::size_t thread) const { return begin(thread + 1); }
    /// Which are given as soon as block b has been found.
    std::span<const std::uint32_t> after(std::size_t b) const {
        return {given_.data() + given_until_[b], given_.data() + given_until_[b + 1]};
    }
    /// Which are given when all have been found.
    std::span<const std::uint32_t> last() const { return last_; }
    /// Where a block keeps what it finds, one of rooms().
    std::size_t room(std::size_t b) const { return room_[b]; }
    std::size_t rooms() const { return rooms_; }

  private:
    void order(std::span<const Reach> reach);
    void assign_rooms(std::span<const Reach> reach);

    std::size_t threads_ = 0, rooms_ = 0;
    std::vector<std::uint32_t> given_, last_, room_;
    std::vector<std::size_t> given_until_;
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parts.hpp>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace spam {

/// Partners of our particles that live in other parts of the run (core/parts.hpp). A law has places for its own
/// particles, in ascending number, and behind them for those. Numbers are those among all particles of the law, in the
/// whole run; where it is in one part place and number are the same, and there are no others.
class OtherPartners {
  public:
    static constexpr std::uint32_t nowhere = ~0U;

    /// Of a law that has so many particles here; places from `behind` on are for others. All parts make it together,
    /// where Parts::number(0) is that of its first particle.
    OtherPartners(std::size_t particles, std::size_t behind);

    /// Whether the run is in one part.
    bool none() const { return home_.empty(); }
    /// One behind the last one.
    std::size_t places() const { return behind_ + others_.size(); }
    bool elsewhere(std::size_t place) const { return place >= behind_; }
    std::uint32_t number(std::size_t place) const {
        if (none()) return static_cast<std::uint32_t>(place);
        return elsewhere(place) ? others_[place - behind_] : numbers_[place];
    }
    /// `nowhere` where it is neither one of our own nor a partner.
    std::uint32_t place(std::uint32_t number) const;
    /// The part that has it.
    std::uint32_t home(std::uint32_t number) const { return home_[number]; }

    /// Those of other parts among these numbers are the partners now. Returns where the partners so far are: by what
    /// their places were behind our own, `nowhere` for those that are none any more. A call of all parts.
    std::vector<std::uint32_t> set(std::vector<std::uint32_t> numbers);

    /// take(place, value) of every partner elsewhere, of what is own(place) at its home. A call of all parts.
    template <class Value, class Own, class Take>
    void fetch(const Own& own, const Take& take) const {
        if (!none()) exchange<Value>(give_, take_, own, take);
    }
    /// The same for any places, by part: of those that it is given, and of what comes from there in the same order.
    template <class Value, class Own, class Take>
    static void exchange(const std::vector<std::vector<std::uint32_t>>& given,
                         const std::vector<std::vector<std::uint32_t>>& taken, const Own& own,
                         const Take& take) {
        Parts& parts = Parts::here();
        std::vector<Parts::Bytes> messages(parts.count());
        std::vector<Value> values;
        for (std::size_t p = 0; p < parts.count(); ++p) {
            values.clear();
            for (const std::uint32_t k : given[p]) values.push_back(own(k));
            messages[p] = Parts::bytes_of(std::span<const Value>(values));
        }
        const auto received = parts.exchange(std::move(messages), Parts::Content::images);
        for (std::size_t p = 0; p < parts.count(); ++p) {
            const auto theirs = Parts::values_of<Value>(received[p]);
            if (theirs.size() != taken[p].size())
                throw std::logic_error("parts disagree on what they exchange");
            for (std::size_t n = 0; n < taken[p].size(); ++n) take(taken[p][n], theirs[n]);
        }
    }

  private:
    std::size_t behind_;
    std::vector<std::uint32_t> numbers_, others_;  ///< of our own; of partners elsewhere, ascending
    std::vector<std::uint32_t> home_;              ///< by number
    std::vector<std::vector<std::uint32_t>> give_, take_;  ///< places, by part
};

}  // namespace spam

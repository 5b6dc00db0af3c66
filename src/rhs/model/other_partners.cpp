// SPDX-License-Identifier: GPL-3.0-or-later
#include "other_partners.hpp"

#include <algorithm>
#include <limits>

namespace spam {

OtherPartners::OtherPartners(std::size_t particles, std::size_t behind) : behind_(behind) {
    Parts& parts = Parts::here();
    if (parts.alone()) return;
    const auto first = static_cast<std::uint32_t>(
        -parts.most(particles > 0 ? -static_cast<double>(parts.number(0))
                                  : -std::numeric_limits<double>::max()));
    for (std::size_t i = 0; i < particles; ++i) numbers_.push_back(parts.number(i) - first);
    home_.resize(parts.total(particles));
    const auto held = parts.gather(std::span<const std::uint32_t>(numbers_));
    for (std::uint32_t p = 0; p < held.size(); ++p)
        for (const std::uint32_t i : held[p]) home_[i] = p;
    give_.resize(parts.count());
    take_.resize(parts.count());
}

std::uint32_t OtherPartners::place(std::uint32_t number) const {
    if (none()) return number;
    const bool own = home_[number] == Parts::here().own();
    const auto& all = own ? numbers_ : others_;
    const auto at = std::ranges::lower_bound(all, number);
    if (at == all.end() || *at != number) return nowhere;
    return static_cast<std::uint32_t>((own ? 0 : behind_) +
                                      static_cast<std::size_t>(at - all.begin()));
}

std::vector<std::uint32_t> OtherPartners::set(std::vector<std::uint32_t> numbers) {
    if (none()) return {};
    Parts& parts = Parts::here();
    std::erase_if(numbers, [&](std::uint32_t i) { return home_[i] == parts.own(); });
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    const std::vector<std::uint32_t> before = std::exchange(others_, std::move(numbers));
    std::vector<std::vector<std::uint32_t>> wanted(parts.count());
    for (std::size_t p = 0; p < parts.count(); ++p) take_[p].clear();
    for (std::size_t n = 0; n < others_.size(); ++n) {
        wanted[home_[others_[n]]].push_back(others_[n]);
        take_[home_[others_[n]]].push_back(static_cast<std::uint32_t>(behind_ + n));
    }
    std::vector<Parts::Bytes> messages;
    for (const auto& of_part : wanted)
        messages.push_back(Parts::bytes_of(std::span<const std::uint32_t>(of_part)));
    const auto received = parts.exchange(std::move(messages));
    for (std::size_t p = 0; p < parts.count(); ++p) {
        give_[p] = Parts::values_of<std::uint32_t>(received[p]);
        for (std::uint32_t& i : give_[p]) i = place(i);
    }
    std::vector<std::uint32_t> now;
    for (const std::uint32_t i : before) now.push_back(place(i));
    return now;
}

}  // namespace spam

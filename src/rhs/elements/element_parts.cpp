// SPDX-License-Identifier: GPL-3.0-or-later
// Elements in one part of a run (core/parts.hpp): those whose first corner is there. Other parts tell where their
// corners are, and get the forces on them one by one, so that each node adds up the same numbers in the same order.
#include "../model/other_partners.hpp"
#include <spam/core/parts.hpp>
#include <spam/rhs/elements.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace spam {

/// Keeps our own elements of those of the whole run. Every part goes through all, and so knows without asking what the
/// others want of it, in their order.
void Elements::divide() {
    Parts& parts = Parts::here();
    const std::size_t own = parts.own(), first = among().first(), count = among().count();
    std::vector<std::vector<std::uint32_t>> held{std::vector<std::uint32_t>(count)};
    if (parts.alone())
        std::iota(held[0].begin(), held[0].end(), static_cast<std::uint32_t>(first));
    else
        held = parts.gather(parts.numbers().subspan(first, count));
    std::uint32_t last = 0;
    for (const auto& numbers : held)
        if (!numbers.empty()) last = std::max(last, numbers.back());
    std::vector<std::size_t> home(last + 1);  // the part of each node
    for (std::size_t p = 0; p < held.size(); ++p)
        for (const std::uint32_t i : held[p]) home[i] = p;
    const auto place_of = [&](std::uint32_t number) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(held[own], number) -
                                          held[own].begin());
    };

    const std::vector<Quadrilateral> all = std::move(nature_.elements);
    const std::vector<std::int32_t> material = std::move(material_);
    nature_.elements.clear();
    material_.clear();
    for (auto* const of_parts : {&give_, &take_, &push_, &pulled_})
        of_parts->assign(held.size(), {});
    std::vector<std::uint32_t> numbers, theirs;  // of our elements, of their corners elsewhere
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::size_t at = home[all[k][0]];
        for (const std::uint32_t i : all[k]) {
            const std::size_t p = home[i];
            if (at == own && p != own) theirs.push_back(i);
            if (at != own && p == own) give_[at].push_back(place_of(i));
        }
        if (at != own) continue;
        numbers.push_back(static_cast<std::uint32_t>(k));
        nature_.elements.push_back(all[k]);
        if (!material.empty()) material_.push_back(material[k]);
    }
    const auto ascending_once = [](std::vector<std::uint32_t>& some) {
        std::ranges::sort(some);
        some.erase(std::unique(some.begin(), some.end()), some.end());
    };
    ascending_once(theirs);
    for (auto& given : give_) ascending_once(given);
    for (std::size_t n = 0; n < theirs.size(); ++n)
        take_[home[theirs[n]]].push_back(static_cast<std::uint32_t>(n));
    others_ = theirs.size();

    // Each node's forces in the order of all elements; those of other parts' are kept behind our own.
    std::vector<std::vector<std::size_t>> of_node(count);
    std::size_t mine = 0, pulled = 4 * numbers.size();
    for (const Quadrilateral& one : all) {
        const std::size_t at = home[one[0]];
        for (std::size_t c = 0; c < 4; ++c) {
            const std::size_t p = home[one[c]];
            const std::size_t force = at == own ? 4 * mine + c : pulled;
            if (p == own) of_node[place_of(one[c])].push_back(force);
            if (at == own && p != own) push_[p].push_back(static_cast<std::uint32_t>(force));
            if (at == own || p != own) continue;
            pulled_[at].push_back(static_cast<std::uint32_t>(pulled++));
        }
        if (at == own) ++mine;
    }
    force_.resize((pulled + 3) / 4);
    start_.assign(1, 0);
    for (const auto& forces : of_node) {
        at_.insert(at_.end(), forces.begin(), forces.end());
        start_.push_back(at_.size());
    }
    for (Quadrilateral& one : nature_.elements)
        for (std::uint32_t& i : one) {
            const std::size_t place =
                home[i] == own ? place_of(i)
                               : count + static_cast<std::size_t>(
                                             std::ranges::lower_bound(theirs, i) - theirs.begin());
            i = static_cast<std::uint32_t>(first + place);
        }
    if (!parts.alone()) parts.set_elements(std::move(numbers));
}

std::size_t Elements::number_of(std::size_t element) const {
    const auto numbers = Parts::here().elements();
    return numbers.empty() ? element : numbers[element];
}

auto Elements::nodes_of(const ConstState<2>& state) const -> Nodes {
    const double *const x = state.position().data(), *const v = state.velocity().data();
    return {state, {x, v}, other_nodes(x, v)};
}

std::vector<double> Elements::other_nodes(const double* x, const double* v) const {
    std::vector<double> others(4 * others_);
    if (Parts::here().alone()) return others;
    OtherPartners::exchange<std::array<double, 4>>(
        give_, take_,
        [&](std::size_t i) {
            return std::array{x[2 * i], x[2 * i + 1], v[2 * i], v[2 * i + 1]};
        },
        [&](std::size_t n, const auto& numbers) { std::ranges::copy(numbers, &others[4 * n]); });
    return others;
}

/// Forces of our elements on nodes elsewhere go there, those of other elements on ours come.
void Elements::meet_other_forces() {
    if (Parts::here().alone()) return;
    OtherPartners::exchange<Vec<2>>(
        push_, pulled_, [&](std::size_t k) { return force_[k / 4][k % 4]; },
        [&](std::size_t k, const Vec<2>& force) { force_[k / 4][k % 4] = force; });
}

}  // namespace spam

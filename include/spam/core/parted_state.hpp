// SPDX-License-Identifier: GPL-3.0-or-later
// y of a run in several parts (parts.hpp): of the whole from the parts', and a part's from the whole.
#pragma once

#include <spam/core/field_layout.hpp>
#include <spam/core/parts.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace spam {

/// The numbers of those that hold a block.
inline std::span<const std::uint32_t> own_numbers(const Parts& parts, Holder holder) {
    return holder == Holder::element ? parts.elements() : parts.numbers();
}

/// Writes y of the whole run, by number of the particle or element, from `own` of each part, whose layout this is, to
/// `whole`, which has its length; accounts, of which every part has a copy, as they are. A call that all parts make
/// together. No second copy of the whole is made, which large runs might have no room for.
template <int Dim>
void whole_state(Parts& parts, const FieldLayout<Dim>& layout, std::span<const double> own,
                 std::span<double> whole) {
    if (parts.alone()) {
        std::ranges::copy(own, whole.begin());
        return;
    }
    std::array<std::vector<std::vector<std::uint32_t>>, 2> numbers;  // of particles and elements
    std::size_t begin = 0;
    for (const auto& block : layout.blocks()) {
        const auto values = own.subspan(block.offset, block.size);
        if (block.field.role() == Role::account) {
            std::ranges::copy(values, whole.subspan(begin).begin());
            begin += values.size();
            continue;
        }
        auto& theirs = numbers[block.holder == Holder::element ? 1 : 0];
        if (theirs.empty()) theirs = parts.gather(own_numbers(parts, block.holder));
        const auto all = parts.gather(values);
        const std::size_t of_one = block.components;
        std::size_t count = 0;
        for (std::size_t p = 0; p < theirs.size(); ++p) {
            for (std::size_t k = 0; k < theirs[p].size(); ++k)
                std::copy_n(&all[p][k * of_one], of_one, &whole[begin + theirs[p][k] * of_one]);
            count += theirs[p].size();
        }
        begin += count * of_one;
    }
}

/// y of this part, from that of the whole run, whose layout this is.
template <int Dim>
std::vector<double> own_state(const Parts& parts, const FieldLayout<Dim>& layout,
                              std::span<const double> whole) {
    std::vector<double> own;
    for (const auto& block : layout.blocks()) {
        const auto all = whole.subspan(block.offset, block.size);
        const auto values =
            block.field.role() == Role::account
                ? std::vector<double>(all.begin(), all.end())
                : parts.own_of(all, block.components, own_numbers(parts, block.holder));
        own.insert(own.end(), values.begin(), values.end());
    }
    return own;
}

}  // namespace spam

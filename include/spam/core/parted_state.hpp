// SPDX-License-Identifier: GPL-3.0-or-later
// y of a run in several parts (parts.hpp): of the whole from the parts', and a part's from the whole.
#pragma once

#include <spam/core/field_layout.hpp>
#include <spam/core/parts.hpp>

#include <span>
#include <vector>

namespace spam {

/// The numbers of those that hold a block.
inline std::span<const std::uint32_t> own_numbers(const Parts& parts, Holder holder) {
    return holder == Holder::element ? parts.elements() : parts.numbers();
}

/// y of the whole run, by number of the particle or element, from `own` of each part, whose layout this is; accounts,
/// of which every part has a copy, as they are. A call that all parts make together.
template <int Dim>
std::vector<double> whole_state(Parts& parts, const FieldLayout<Dim>& layout,
                                std::span<const double> own) {
    std::vector<double> whole;
    for (const auto& block : layout.blocks()) {
        const auto values = own.subspan(block.offset, block.size);
        if (block.field.role() == Role::account) {
            whole.insert(whole.end(), values.begin(), values.end());
            continue;
        }
        const auto all =
            parts.by_number(values, block.components, own_numbers(parts, block.holder));
        whole.insert(whole.end(), all.begin(), all.end());
    }
    return whole;
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

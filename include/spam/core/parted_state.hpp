// SPDX-License-Identifier: GPL-3.0-or-later
// y of a run in several parts (parts.hpp): of the whole from the parts', and a part's from the whole.
#pragma once

#include <spam/core/field_layout.hpp>
#include <spam/core/parts.hpp>

#include <span>
#include <vector>

namespace spam {

/// y of the whole run, by number of the particle, from `own` of each part, whose layout this is; accounts, of which
/// every part has a copy, as they are. A call that all parts make together.
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
        const auto all = parts.by_number(values, block.components);
        whole.insert(whole.end(), all.begin(), all.end());
    }
    return whole;
}

/// y of this part, from that of the whole run with n particles; of the layout only fields count.
template <int Dim>
std::vector<double> own_state(const Parts& parts, const FieldLayout<Dim>& layout, std::size_t n,
                              std::span<const double> whole) {
    std::vector<double> own;
    std::size_t offset = 0;
    for (const auto& block : layout.blocks()) {
        const bool account = block.field.role() == Role::account;
        const auto all = whole.subspan(offset, account ? block.size : n * block.components);
        offset += all.size();
        const auto values = account ? std::vector<double>(all.begin(), all.end())
                                    : parts.own_of(all, block.components);
        own.insert(own.end(), values.begin(), values.end());
    }
    return own;
}

}  // namespace spam

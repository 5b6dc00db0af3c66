// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>

#include <spam_levels.h>

#include <type_traits>

namespace spam {

/// Whether this build has what is compiled for the set.
constexpr bool is_built(InstructionSet set) {
    for (const InstructionSet built : {SPAM_LEVEL_LIST})
        if (built == set) return true;
    return false;
}

namespace detail {

template <InstructionSet First, InstructionSet... Others, class F>
auto at_one_of(InstructionSet set, const F& f) {
    if constexpr (sizeof...(Others) > 0)
        if (set != First) return at_one_of<Others...>(set, f);
    return f(std::integral_constant<InstructionSet, First>{});
}

}  // namespace detail

/// f(level) for the instruction set as a compile-time constant: how to reach what a *.lanes.cpp
/// defines, a template of the level that each compilation of the file instantiates for its own
/// (SPAM_LEVEL). Precondition: is_built(set), as of instruction_set().
template <class F>
auto at_level(InstructionSet set, const F& f) {
    return detail::at_one_of<SPAM_LEVEL_LIST>(set, f);
}

}  // namespace spam

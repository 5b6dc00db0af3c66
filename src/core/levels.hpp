// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>

#include <type_traits>

namespace spam {

/// f(level) for the instruction set as a compile-time constant: how to reach what a *.lanes.cpp
/// defines, a template of the level that each compilation of the file instantiates for its own
/// (SPAM_LEVEL).
template <class F>
auto at_level(InstructionSet set, const F& f) {
#if defined(SPAM_X86_LEVELS)
    switch (set) {
        case InstructionSet::v4:
            return f(std::integral_constant<InstructionSet, InstructionSet::v4>{});
        case InstructionSet::v3:
            return f(std::integral_constant<InstructionSet, InstructionSet::v3>{});
        default:
            return f(std::integral_constant<InstructionSet, InstructionSet::v2>{});
    }
#else
    static_cast<void>(set);
    return f(std::integral_constant<InstructionSet, InstructionSet::generic>{});
#endif
}

}  // namespace spam

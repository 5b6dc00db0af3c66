// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace spam {

/// What the sources that are compiled several times (*.lanes.cpp) were compiled for: the levels of
/// x86-64 (SSE4.2; AVX2 and FMA; AVX-512), or whatever the compiler does by itself.
enum class InstructionSet { generic, v2, v3, v4 };

/// The one in use: the best that this processor has, or the one that the environment variable
/// SPAM_ISA names (v2, v3, v4). Settled by the first call. Throws InputError if SPAM_ISA is no such
/// name or more than the processor can do.
InstructionSet instruction_set();

/// How many doubles fill one register: 2, 4 or 8.
constexpr int native_lanes(InstructionSet set) {
    return set == InstructionSet::v4 ? 8 : set == InstructionSet::v3 ? 4 : 2;
}

std::string_view to_string(InstructionSet set);  ///< "x86-64-v3"

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels.hpp"
#include <spam/core/error.hpp>
#include <spam/core/look_ahead.hpp>

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

namespace spam {
namespace {

InstructionSet best_of_processor() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        return InstructionSet::v4;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2"))
        return InstructionSet::v3;
    if (__builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt"))
        return InstructionSet::v2;
#endif
    return InstructionSet::generic;
}

/// The best that is built and that the processor can do.
InstructionSet best() {
    const InstructionSet most = best_of_processor();
    for (const auto set : {InstructionSet::v4, InstructionSet::v3, InstructionSet::v2})
        if (set <= most && is_built(set)) return set;
    if (is_built(InstructionSet::generic)) return InstructionSet::generic;
    throw InputError(
        fmt::format("this build is for better processors than this one ({}); build it here, with "
                    "-DSPAM_LEVELS='v2;v3;v4' or, for any processor, -DSPAM_LEVELS=generic",
                    to_string(most)));
}

InstructionSet chosen() {
    const char* const wish = std::getenv("SPAM_ISA");
    if (wish == nullptr || *wish == '\0') return best();
    for (const auto set : {InstructionSet::v2, InstructionSet::v3, InstructionSet::v4}) {
        if (to_string(set) != std::string("x86-64-") + wish) continue;
        if (!(set <= best_of_processor()))
            throw InputError(fmt::format(
                "SPAM_ISA: {} is more than this processor can do ({}); unset it, or choose less",
                wish, to_string(best_of_processor())));
        if (is_built(set)) return set;
        throw InputError(
            fmt::format("SPAM_ISA: {} is not in this build, which has {}; unset it, or build with "
                        "-DSPAM_LEVELS='v2;v3;v4' (./spam test and ./spam bench do)",
                        wish, to_string(best())));
    }
    throw InputError(
        fmt::format("SPAM_ISA: no instruction set '{}'; there are v2, v3 and v4", wish));
}

std::size_t chosen_ahead() {
    const char* const wish = std::getenv("SPAM_AHEAD");
    if (wish == nullptr || *wish == '\0') return most_neighbours_ahead;
    for (const std::size_t ahead : {1U, 2U, 4U})
        if (wish == std::to_string(ahead)) return ahead;
    throw InputError(fmt::format(
        "SPAM_AHEAD: sweeps look 1, 2 or 4 neighbours ahead, not '{}'; unset it for 4", wish));
}
std::size_t& ahead() {
    static std::size_t ahead = chosen_ahead();
    return ahead;
}

}  // namespace

InstructionSet instruction_set() {
    static const InstructionSet set = [] {
        ahead();  // here, outside of all sweeps, a wrong SPAM_AHEAD is refused
        return chosen();
    }();
    return set;
}

std::size_t neighbours_ahead() { return ahead(); }

std::size_t set_neighbours_ahead(std::size_t now) { return std::exchange(ahead(), now); }

std::string_view to_string(InstructionSet set) {
    switch (set) {
        case InstructionSet::v2:
            return "x86-64-v2";
        case InstructionSet::v3:
            return "x86-64-v3";
        case InstructionSet::v4:
            return "x86-64-v4";
        case InstructionSet::generic:
            break;
    }
    return "generic";
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of runs on several processes share.
#pragma once

#include <spam/core/program.hpp>
#include <spam/processes/processes.hpp>

#include <algorithm>
#include <string>

namespace spam::test {

/// Without MPI every case but one ends with the line that says so.
inline bool no_ranks() {
    return !spam::why_one_process().empty() || spam::find_program("mpirun").empty();
}

inline std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace spam::test

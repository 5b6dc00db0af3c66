// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace spam {

/// Cores that this process may use: without the second thread of a core, without processors that its
/// affinity or the quota of its control group (Linux) leave out; no more than OMP_NUM_THREADS, where that is
/// a number. At least 1.
int usable_cores();

/// How many threads are worth starting for sums over so many particles on so many cores.
int worthwhile_threads(std::size_t particles, int cores);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spam {

/// Starts as many threads as later sweeps will use, and keeps them. Throws InputError where they cannot
/// be had: OpenMP itself would end the program.
void start_threads(int threads);

}  // namespace spam

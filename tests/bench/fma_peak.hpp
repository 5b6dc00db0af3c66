// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace spam::bench {

/// Floating-point operations per second of one core that does nothing but fused multiplications and
/// additions in full registers of the instruction set in use (where it has none of them: of separate
/// ones), measured now: the best of some tries.
double fma_peak();

}  // namespace spam::bench

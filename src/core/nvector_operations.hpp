// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>

#include <sundials/sundials_nvector.h>

namespace spam {

/// Puts our own loops into the operations table of a serial N_Vector (clones inherit it). Debian's
/// are compiled without optimisation and cost more than a right-hand side. Sums are exact (ExactSum):
/// norms, and with them adaptive steps, have the same bits with any number of threads.
template <InstructionSet Level>
void use_operations(N_Vector v);

}  // namespace spam

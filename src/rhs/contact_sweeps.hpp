// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>
#include <spam/rhs/sweeps.hpp>

namespace spam {

/// A core between bodies, of BodyRecord.
template <int Dim, InstructionSet Level>
Sweeps<Dim> contact_sweeps();

}  // namespace spam

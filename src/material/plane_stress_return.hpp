// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/instruction_set.hpp>
#include <spam/material/plane_stress_return.hpp>

namespace spam {

template <InstructionSet Level>
void return_plane_stress_at(const PlaneStressVonMises& surface, const LinearHardening& flow,
                            std::size_t count, const double* plastic_strain, const double* trial,
                            double* to);

}  // namespace spam

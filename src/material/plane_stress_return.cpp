// SPDX-License-Identifier: GPL-3.0-or-later
#include "plane_stress_return.hpp"

#include "../core/levels.hpp"

namespace spam {

void return_plane_stress(const PlaneStressVonMises& surface, const LinearHardening& flow,
                         std::size_t count, const double* plastic_strain, const double* trial,
                         double* to) {
    at_level(instruction_set(), [&](auto level) {
        return_plane_stress_at<level>(surface, flow, count, plastic_strain, trial, to);
    });
}

}  // namespace spam

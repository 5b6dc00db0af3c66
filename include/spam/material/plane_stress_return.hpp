// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/linear_hardening.hpp>
#include <spam/material/von_mises.hpp>

#include <cstddef>

namespace spam {

/// The stresses that PlaneStressVonMises::returned() finds for `count` particles with these plastic strains, to
/// rounding error, in lanes: trial and `to` have three numbers (xx, yy, xy) for each and may be the same.
void return_plane_stress(const PlaneStressVonMises& surface, const LinearHardening& flow,
                         std::size_t count, const double* plastic_strain, const double* trial,
                         double* to);

}  // namespace spam

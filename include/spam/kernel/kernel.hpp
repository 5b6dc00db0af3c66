// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

namespace spam {

/// Which weight function: Lucy's, Monaghan's cubic spline, or a member of the family w_n (w3 is Lucy's).
enum class Kernel { lucy, monaghan, w2, w3, w4, w5, w6, w7, w8 };

std::string_view to_string(Kernel);

/// All of them, in the order of the enumeration.
const std::vector<Kernel>& all_kernels();

}  // namespace spam

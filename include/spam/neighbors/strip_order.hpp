// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>

#include <cstdint>
#include <vector>

namespace spam {

/// A permutation that puts neighbours in space next to each other in memory: strips (columns in 3D)
/// of width `width` across all directions but the last, sorted by the last coordinate inside a
/// strip. order[k] is the old index of the particle that becomes number k. Ties keep the old order.
template <int Dim>
std::vector<std::uint32_t> strip_order(const Points<Dim>& position, double width);

}  // namespace spam

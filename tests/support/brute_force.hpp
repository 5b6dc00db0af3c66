// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/box.hpp>

#include <cstdint>
#include <vector>

namespace spam {

/// The oracle: all j with |r_ij| < cutoff (nearest image), i itself included, ascending, found by
/// looking at every pair. O(N^2), for tests and for questions asked once.
template <int Dim>
std::vector<std::vector<std::uint32_t>> brute_force_neighbours(const Points<Dim>& position,
                                                               double cutoff, const Box<Dim>& box) {
    const auto n = static_cast<std::size_t>(position.cols());
    std::vector<std::vector<std::uint32_t>> result(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            double r2 = 0.0;
            for (int a = 0; a < Dim; ++a) {
                double s = position(a, static_cast<Eigen::Index>(i)) -
                           position(a, static_cast<Eigen::Index>(j));
                if (box.periodic(a)) s -= box.length(a) * std::round(s / box.length(a));
                r2 += s * s;
            }
            if (r2 < cutoff * cutoff) result[i].push_back(static_cast<std::uint32_t>(j));
        }
    }
    return result;
}

}  // namespace spam

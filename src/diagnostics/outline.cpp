// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/outline.hpp>
#include <spam/neighbors/pair_list.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

std::vector<Eigen::Index> outline(const Points<2>& reference, double spacing) {
    const PairList<2> list(reference, 1.2 * spacing, {});
    std::size_t most = 0;
    for (std::size_t i = 0; i < list.size(); ++i) most = std::max(most, list.neighbours(i).size());
    std::vector<Eigen::Index> ring;
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list.neighbours(i).size() < most) ring.push_back(static_cast<Eigen::Index>(i));
    const Point<2> centre = reference.rowwise().mean();
    const auto angle = [&](Eigen::Index i) {
        const Point<2> r = reference.col(i) - centre;
        return std::atan2(r.y(), r.x());
    };
    std::ranges::sort(ring, [&](Eigen::Index a, Eigen::Index b) { return angle(a) < angle(b); });
    return ring;
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "roundness.hpp"

#include <spam/core/exact_sum.hpp>

#include <cmath>

namespace spam {

/// r^4 cos 4 theta = x^4 - 6 x^2 y^2 + y^4: no angles.
double fourfold_moment(const Points<2>& position, std::span<const double> mass) {
    ExactSum m, mx, my;
    for (std::size_t i = 0; i < mass.size(); ++i) {
        m += mass[i];
        mx += mass[i] * position(0, static_cast<Eigen::Index>(i));
        my += mass[i] * position(1, static_cast<Eigen::Index>(i));
    }
    const Point<2> centre = Point<2>(mx, my) / double(m);
    ExactSum fourfold, all;
    for (std::size_t i = 0; i < mass.size(); ++i) {
        const Point<2> r = position.col(static_cast<Eigen::Index>(i)) - centre;
        const double x2 = r.x() * r.x(), y2 = r.y() * r.y();
        fourfold += mass[i] * (x2 * x2 - 6.0 * x2 * y2 + y2 * y2);
        all += mass[i] * (x2 + y2) * (x2 + y2);
    }
    return std::abs(fourfold) / all;
}

}  // namespace spam

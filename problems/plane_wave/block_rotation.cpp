// SPDX-License-Identifier: GPL-3.0-or-later

#include "block_rotation.hpp"

#include <cmath>
#include <vector>

namespace spam {
namespace {

/// From `centre` to the nearest image of a reference position.
Point<2> offset(const Box<2>& box, const Point<2>& reference, const Point<2>& centre) {
    Point<2> s = reference - centre;
    for (int a = 0; a < 2; ++a)
        if (box.periodic(a)) s[a] -= box.length(a) * std::round(s[a] / box.length(a));
    return s;
}

BlockRotation one_block(const Model<2>& model, const Points<2>& position, const Points<2>& velocity,
                        const Point<2>& centre, double side) {
    const Points<2>& reference = model.particles().reference_position;
    std::vector<Eigen::Index> members;
    std::vector<Point<2>> x;  // from the centre, images taken by the reference
    double mass = 0.0;
    Point<2> mean_x = Point<2>::Zero(), mean_v = Point<2>::Zero();
    for (Eigen::Index i = 0; i < reference.cols(); ++i) {
        const Point<2> s = offset(model.box(), reference.col(i), centre);
        // Half open: of two edges a particle may lie on, one counts.
        if (s.minCoeff() < -0.5 * side || s.maxCoeff() >= 0.5 * side) continue;
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        members.push_back(i);
        x.push_back(s + position.col(i) - reference.col(i));
        mass += m;
        mean_x += m * x.back();
        mean_v += m * velocity.col(i);
    }
    BlockRotation block;
    if (members.empty()) return block;
    mean_x /= mass;
    mean_v /= mass;
    for (std::size_t k = 0; k < members.size(); ++k) {
        const double m = model.particles().mass[static_cast<std::size_t>(members[k])];
        const Point<2> dx = x[k] - mean_x, dv = velocity.col(members[k]) - mean_v;
        block.angular_momentum += m * (dx.x() * dv.y() - dx.y() * dv.x());
        block.second_moment += m * dx.y() * dx.y();
    }
    return block;
}

}  // namespace

BlockRotation block_rotation(const Model<2>& model, const Points<2>& position,
                             const Points<2>& velocity, const Point<2>& centre, double side,
                             int shifts) {
    const double spacing = model.particles().spacing;
    const double share = 1.0 / (shifts * shifts);
    BlockRotation mean;
    for (int p = 0; p < shifts; ++p)
        for (int q = 0; q < shifts; ++q) {
            const Point<2> shift((p + 0.5) / shifts - 0.5,
                                 ((q + 0.5) / shifts - 0.5) * std::sqrt(0.75));
            const auto block = one_block(model, position, velocity, centre + spacing * shift, side);
            mean.angular_momentum += share * block.angular_momentum;
            mean.second_moment += share * block.second_moment;
        }
    return mean;
}

}  // namespace spam

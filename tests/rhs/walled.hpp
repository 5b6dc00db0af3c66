// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes with every kind of wall around the body of combinations.hpp.
#pragma once

#include "rhs/combinations.hpp"

namespace spam::test {

/// Walls of one kind on all sides, outside the body, and further apart than any range.
inline const std::map<std::string, Wall<2>> walls{
    {"mirror", {WallKind::mirror, 0.0, {0, 0}, {}}},
    {"mirror of a temperature", {WallKind::mirror, 0.0, {0, 0}, 0.3}},
    {"no_slip", {WallKind::no_slip, 0.0, {0, 0}, {}}},
    {"no_slip of a temperature", {WallKind::no_slip, 0.0, {0, 0}, 0.3}},
    {"no_slip that moves", {WallKind::no_slip, 0.0, {0.02, 0.02}, {}}},
    {"rigid", {WallKind::rigid, 0.0, {0, 0}, {}}}};

inline Box<2> walled_by(Wall<2> wall, const Units& units = {}) {
    const Points<2> x = triangular_block(8, 5);
    const Point<2> along = units.of("l/t", 2) * wall.velocity;
    if (wall.temperature) *wall.temperature *= units.of("l^2/t^2", 2);
    Box<2> box;
    for (int a = 0; a < 2; ++a)
        for (const bool upper : {false, true}) {
            wall.at =
                units.length * (upper ? x.row(a).maxCoeff() + 1.5 : x.row(a).minCoeff() - 0.5);
            wall.velocity = along;
            wall.velocity[a] = 0.0;
            box.set_wall(a, upper, wall);
        }
    return box;
}

}  // namespace spam::test

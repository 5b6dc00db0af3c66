// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes with every kind of wall around the body of combinations.hpp.
#pragma once

#include "rhs/combinations.hpp"

namespace spam::test {

/// Walls of one kind on all sides, outside the body, and further apart than any range.
template <int Dim>
inline const std::map<std::string, Wall<Dim>> walls{
    {"mirror", {.kind = WallKind::mirror}},
    {"mirror of a temperature", {.kind = WallKind::mirror, .temperature = 0.3}},
    {"no_slip", {.kind = WallKind::no_slip}},
    {"no_slip of a temperature", {.kind = WallKind::no_slip, .temperature = 0.3}},
    {"no_slip that moves", {.kind = WallKind::no_slip, .velocity = point<Dim>(0.02, 0.02, 0.02)}},
    {"rigid", {.kind = WallKind::rigid}}};

template <int Dim>
Box<Dim> walled_by(Wall<Dim> wall, const Units& units = {}) {
    const Points<Dim> x = block<Dim>();
    const Point<Dim> along = units.of("l/t", Dim) * wall.velocity;
    if (wall.temperature) *wall.temperature *= units.of("l^2/t^2", Dim);
    Box<Dim> box;
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true}) {
            wall.at = units.length * (upper ? x.row(a).maxCoeff() + (Dim == 2 ? 1.5 : 3.5)
                                            : x.row(a).minCoeff() - 0.5);
            wall.velocity = along;
            wall.velocity[a] = 0.0;
            box.set_wall(a, upper, wall);
        }
    return box;
}

}  // namespace spam::test

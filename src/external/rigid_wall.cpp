// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/external/rigid_wall.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

template <int Dim>
RigidWall<Dim>::RigidWall(const Point<Dim>& normal, double place, double energy, double range)
    : normal_(normal.normalized()),
      h_(place),
      energy_(energy),
      range_(range) {
    if (!(normal.norm() > 0.0) || !normal.allFinite() || !std::isfinite(place))
        throw InputError(fmt::format(
            "wall: a plane at {} along a normal of length {} is nowhere; give a place and "
            "a direction",
            place, normal.norm()));
    if (!(energy > 0.0) || !std::isfinite(energy) || !(range > 0.0) || !std::isfinite(range))
        throw InputError(fmt::format(
            "wall: energy {:g} and range {:g} must be above 0, or it would hold nothing back; try 1 "
            "and a spacing",
            energy, range));
}

template <int Dim>
RigidWall<Dim>::RigidWall(const Point<Dim>& normal, Place place, double energy, double range)
    : RigidWall(normal, place(0.0), energy, range) {
    moving_ = std::move(place);
}

template <int Dim>
std::string RigidWall<Dim>::describe() const {
    std::string words =
        moving_ ? "a rigid wall that moves" : fmt::format("a rigid wall at {:g}", h_);
    constexpr const char* axes = "xyz";
    for (int a = 0; a < Dim; ++a)
        if (std::abs(normal_[a]) == 1.0) words += fmt::format(", across {}", axes[a]);
    return words;
}

SPAM_COMPILED(template class RigidWall);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/neighbors/box.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {

template <int Dim>
std::string Wall<Dim>::describe() const {
    std::string words = kind == WallKind::open     ? "open"
                        : kind == WallKind::mirror ? "mirror"
                        : kind == WallKind::rigid  ? "rigid"
                                                   : "no-slip";
    if (kind == WallKind::no_slip && !velocity.isZero()) {
        words = fmt::format("moving with ({:g}", velocity[0]);
        for (int a = 1; a < Dim; ++a) words += fmt::format(", {:g}", velocity[a]);
        words += ")";
    }
    return temperature ? fmt::format("{}, T = {:g}", words, *temperature) : words;
}

template <int Dim>
void Box<Dim>::set_wall(int a, bool upper, const Wall<Dim>& wall) {
    const char direction = "xyz"[a];
    if (periodic(a))
        throw InputError(fmt::format(
            "wall: direction {} is periodic and has no walls; make both sides of it periodic, or "
            "neither",
            direction));
    if (!std::isfinite(wall.at) || !wall.velocity.allFinite())
        throw InputError(
            fmt::format("wall: place and velocity across direction {} must be finite "
                        "numbers",
                        direction));
    if (wall.velocity[a] != 0.0 || (wall.kind != WallKind::no_slip && !wall.velocity.isZero()))
        throw InputError(fmt::format(
            "wall: across direction {} one moves with ({:g}{}), and only no-slip walls can move, along "
            "themselves; leave the velocity out",
            direction, wall.velocity[0], Dim > 1 ? ", ..." : ""));
    if (wall.temperature && !(*wall.temperature > 0.0 && std::isfinite(*wall.temperature)))
        throw InputError(fmt::format("wall: temperature {:g} across direction {} must be above 0",
                                     *wall.temperature, direction));
    if (wall.temperature && wall.kind == WallKind::rigid)
        throw InputError(fmt::format(
            "wall: a rigid one, across direction {}, has nothing behind it that could be warm; use mirror or "
            "no-slip, or leave the temperature out",
            direction));
    auto& sides = walls_[static_cast<std::size_t>(a)];
    sides[upper ? 1 : 0] = wall;
    if (!sides[0].open() && !sides[1].open() && !(sides[0].at < sides[1].at))
        throw InputError(fmt::format(
            "wall: the lower one across direction {} at {:g} must lie below the upper one "
            "at {:g}",
            direction, sides[0].at, sides[1].at));
}

template <int Dim>
std::string Box<Dim>::describe_walls() const {
    std::string words;
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true})
            if (const auto& wall = this->wall(a, upper); !wall.open())
                words += fmt::format("{}{} at {} = {:g}", words.empty() ? "walls: " : "; ",
                                     wall.describe(), "xyz"[a], wall.at);
    return words;
}

SPAM_COMPILED(template struct Wall);
#define SPAM_INSTANTIATE(D)                                    \
    template void Box<D>::set_wall(int, bool, const Wall<D>&); \
    template std::string Box<D>::describe_walls() const;
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

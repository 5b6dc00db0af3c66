// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/problem/sides.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace spam {
namespace {

constexpr std::array names{"left", "right", "bottom", "top", "front", "back"};

/// A side before it has a place.
template <int Dim>
struct Side {
    bool periodic = false;
    Wall<Dim> wall;
};

template <int Dim>
class Reader {
  public:
    Reader(std::string option, const std::string& words, int axis)
        : option_(std::move(option)),
          words_(words),
          axis_(axis) {}

    Side<Dim> side() const {
        const auto at = words_.find('@');
        const std::string kind = words_.substr(0, at);
        Side<Dim> side;
        if (kind == "periodic")
            side.periodic = true;
        else if (kind == "mirror")
            side.wall.kind = WallKind::mirror;
        else if (kind == "no-slip")
            side.wall.kind = WallKind::no_slip;
        else if (Dim > 1 && kind.starts_with("moving:")) {
            side.wall.kind = WallKind::no_slip;
            side.wall.velocity[axis_ == 0 ? 1 : 0] = number(kind.substr(7), "velocity");
        } else if (kind != "open")
            refuse("is none of open, periodic, mirror, no-slip" +
                   std::string(Dim > 1 ? ", moving:V" : "") +
                   "; walls may have @TEMPERATURE behind");
        if (at == std::string::npos) return side;
        if (side.periodic || side.wall.open())
            refuse("is no wall and has no temperature; leave it out");
        side.wall.temperature = number(words_.substr(at + 1), "temperature");
        if (!(*side.wall.temperature > 0.0)) refuse("has a temperature that is not above 0");
        return side;
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(fmt::format("{}: '{}' {}", option_, words_, why));
    }

  private:
    double number(const std::string& text, const char* what) const {
        double value = 0.0;
        const char* const last = text.data() + text.size();
        const auto [end, error] = std::from_chars(text.data(), last, value);
        if (error != std::errc{} || end != last || !std::isfinite(value))
            refuse(fmt::format("has '{}' for a {}; give a number", text, what));
        return value;
    }

    std::string option_;
    const std::string& words_;
    int axis_;
};

}  // namespace

template <int Dim>
std::string Sides<Dim>::name(int a, bool upper) {
    return names[static_cast<std::size_t>(2 * a + (upper ? 1 : 0))];
}

template <int Dim>
Sides<Dim>::Sides(Options& options, const std::array<std::string, 2 * Dim>& otherwise)
    : words_(otherwise) {
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true})
            options.text(name(a, upper), words_[static_cast<std::size_t>(2 * a + (upper ? 1 : 0))],
                         fmt::format("{} side: open, periodic, mirror, no-slip{}; walls may have "
                                     "@TEMPERATURE behind, else they are insulated",
                                     name(a, upper), Dim > 1 ? ", moving:V" : ""));
}

template <int Dim>
Box<Dim> Sides<Dim>::box(const Point<Dim>& low, const Point<Dim>& high) const {
    const auto reader = [&](int a, bool upper) {
        return Reader<Dim>(name(a, upper),
                           words_[static_cast<std::size_t>(2 * a + (upper ? 1 : 0))], a);
    };
    std::array<double, Dim> lengths{};
    for (int a = 0; a < Dim; ++a) {
        const bool lower = reader(a, false).side().periodic,
                   upper = reader(a, true).side().periodic;
        if (lower != upper)
            reader(a, upper).refuse(fmt::format(
                "but --{} is not; make both of them periodic, or neither", name(a, lower)));
        if (lower) lengths[static_cast<std::size_t>(a)] = high[a] - low[a];
    }
    Box<Dim> box(lengths);
    for (int a = 0; a < Dim; ++a)
        for (const bool upper : {false, true}) {
            Wall<Dim> wall = reader(a, upper).side().wall;
            if (wall.open()) continue;
            wall.at = upper ? high[a] : low[a];
            box.set_wall(a, upper, wall);
        }
    return box;
}

template class Sides<1>;
template class Sides<2>;
template class Sides<3>;

}  // namespace spam

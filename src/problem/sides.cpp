// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/problem/sides.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace spam {
namespace {

std::string allowed(bool along) {
    return std::string("open, periodic, mirror, no-slip") + (along ? ", moving:V" : "") +
           " or rigid";
}

/// A side before it has a place.
template <int Dim>
struct Side {
    bool periodic = false;
    Wall<Dim> wall;
};

template <int Dim>
class Reader {
  public:
    Reader(std::string option, const std::string& words, int axis, const Sides::Meanings& meanings)
        : option_(std::move(option)),
          words_(words),
          axis_(axis) {
        if (const auto other = meanings.find(words_); other != meanings.end())
            words_ = other->second;
        for (const auto& [word, meaning] : meanings) more_ += ", " + word;
    }

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
        else if (kind == "rigid")
            side.wall.kind = WallKind::rigid;
        else if (Dim > 1 && kind.starts_with("moving:")) {
            side.wall.kind = WallKind::no_slip;
            side.wall.velocity[axis_ == 0 ? 1 : 0] = number(kind.substr(7), "velocity");
        } else if (kind != "open")
            refuse("is none of " + allowed(Dim > 1) + more_ +
                   "; mirrors and no-slip walls may have @TEMPERATURE behind");
        if (at == std::string::npos) return side;
        if (side.periodic || side.wall.open())
            refuse("is no wall and has no temperature; leave it out");
        if (side.wall.kind == WallKind::rigid)
            refuse(
                "has nothing behind it that could be warm; use mirror or no-slip, or leave the "
                "temperature out");
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

    std::string option_, words_, more_;
    int axis_;
};

}  // namespace

std::string Sides::name(int a, bool upper) { return name_of_side(a, upper); }

Sides::Sides(Options& options, std::vector<std::string> otherwise, const std::string& more)
    : words_(std::move(otherwise)) {
    for (std::size_t k = 0; k < words_.size(); ++k)
        if (!words_[k].empty())
            options.text(name_of_side(static_cast<int>(k / 2), k % 2 == 1), words_[k],
                         fmt::format("{} side: {}{}; mirrors and no-slip walls may have "
                                     "@TEMPERATURE behind, else they are insulated",
                                     name_of_side(static_cast<int>(k / 2), k % 2 == 1),
                                     allowed(words_.size() > 2), more));
}

std::vector<std::string> Sides::names() const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < words_.size(); ++k)
        if (!words_[k].empty())
            names.emplace_back(name_of_side(static_cast<int>(k / 2), k % 2 == 1));
    return names;
}

template <int Dim>
Box<Dim> Sides::box(const Point<Dim>& low, const Point<Dim>& high, const Meanings& meanings) const {
    const auto reader = [&](int a, bool upper) {
        const std::string& words = words_[static_cast<std::size_t>(2 * a + (upper ? 1 : 0))];
        return Reader<Dim>(name(a, upper), words.empty() ? "open" : words, a, meanings);
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

template Box<1> Sides::box(const Point<1>&, const Point<1>&, const Meanings&) const;
template Box<2> Sides::box(const Point<2>&, const Point<2>&, const Meanings&) const;
template Box<3> Sides::box(const Point<3>&, const Point<3>&, const Meanings&) const;

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/problem/sides.hpp>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace spam {
namespace {

constexpr std::pair<SideKind, const char*> side_words[]{
    {SideKind::open, "open"},       {SideKind::periodic, "periodic"}, {SideKind::mirror, "mirror"},
    {SideKind::no_slip, "no-slip"}, {SideKind::moving, "moving:V"},   {SideKind::rigid, "rigid"}};

// What runs can be expected to survive, in their units: numbers beyond are slips of the pen. Sound has a speed of 1 to
// 1.4, and steps are made for that: walls that are five times as fast leave the energy as exact as it is promised.
constexpr double fastest = 5.0, coldest = 1e-6, hottest = 1e6;

/// "a, b or c"
std::string either(const std::vector<std::string>& words) {
    std::string list;
    for (std::size_t k = 0; k < words.size(); ++k)
        list += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + words[k];
    return list;
}

/// A side before it has a place.
template <int Dim>
struct Side {
    bool periodic = false;
    Wall<Dim> wall;
};

/// Of the words of one option.
template <int Dim>
class Reader {
  public:
    Reader(std::string option, std::string words, int axis, const SideOption& side,
           const Sides::Meanings& meanings, std::string allowed, bool temperatures)
        : option_(std::move(option)),
          words_(std::move(words)),
          axis_(axis),
          side_(side),
          allowed_(std::move(allowed)),
          temperatures_(temperatures) {
        const auto at = std::min(words_.find('@'), words_.size());
        kind_ = words_.substr(0, at);
        if (at < words_.size()) temperature_ = words_.substr(at + 1);
        if (const auto other = meanings.find(kind_); other != meanings.end()) {
            kind_ = other->second;
            words_ = temperature_ ? kind_ + "@" + *temperature_ : kind_;
        }
    }

    Side<Dim> side() const {
        Side<Dim> side;
        const SideKind kind = kind_of_words();
        if (const auto why = side_.excluded.find(kind); why != side_.excluded.end())
            refuse(fmt::format("{}; use {}", why->second, allowed_));
        side.periodic = kind == SideKind::periodic;
        side.wall.kind = kind == SideKind::mirror                                ? WallKind::mirror
                         : kind == SideKind::rigid                               ? WallKind::rigid
                         : kind == SideKind::no_slip || kind == SideKind::moving ? WallKind::no_slip
                                                                                 : WallKind::open;
        if (kind == SideKind::moving) set_velocity(side.wall);
        if (temperature_) side.wall.temperature = temperature_of(side);
        return side;
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(fmt::format("{}: '{}' {}", option_, words_, why));
    }

  private:
    SideKind kind_of_words() const {
        if (kind_.starts_with("moving:")) {
            if (Dim == 1)
                refuse("moves along itself, and on a line there is no such motion; use no-slip");
            return SideKind::moving;
        }
        for (const auto& [kind, name] : side_words)
            if (kind != SideKind::moving && kind_ == name) return kind;
        refuse(fmt::format("is none of {}; give one of these", allowed_));
    }

    /// Along the other axes, in their order: one number, or in space two, with a comma between them.
    void set_velocity(Wall<Dim>& wall) const {
        const char* const example =
            Dim == 3 ? "as in moving:0.1 or moving:0.1,0.2" : "as in moving:0.1";
        std::string words = kind_.substr(7);
        if (words.empty()) number(words, "velocity", -fastest, fastest, example);
        for (int a = 0; a < Dim; ++a) {
            if (a == axis_ || words.empty()) continue;
            const auto comma = Dim == 3 ? words.find(',') : std::string::npos;
            wall.velocity[a] =
                number(words.substr(0, comma), "velocity", -fastest, fastest, example);
            words = comma == std::string::npos ? "" : words.substr(comma + 1);
            if (words.empty() && comma != std::string::npos)
                number(words, "velocity", -fastest, fastest, example);
        }
        if (!words.empty())
            refuse(
                "has a velocity across itself: a wall moves along itself; give no more than two");
    }
    double temperature_of(const Side<Dim>& side) const {
        if (side.periodic || side.wall.open())
            refuse("is no wall and has no temperature; leave it out");
        if (side.wall.kind == WallKind::rigid)
            refuse(
                "has nothing behind it that could be warm; use mirror or no-slip, or leave the "
                "temperature out");
        if (!temperatures_)
            refuse(fmt::format("has a temperature, and nothing here conducts heat; leave '@{}' out",
                               *temperature_));
        return number(*temperature_, "temperature", coldest, hottest, "as in mirror@1.5");
    }

    double number(const std::string& text, const char* what, double least, double most,
                  const char* example) const {
        const auto value = number_in(text);
        if (!value || !(*value >= least && *value <= most))
            refuse(fmt::format("has '{}' for a {}; give a number between {:g} and {:g}, {}", text,
                               what, least, most, example));
        return *value;
    }

    std::string option_, words_, kind_;
    std::optional<std::string> temperature_;
    int axis_;
    const SideOption& side_;
    std::string allowed_;
    bool temperatures_;
};

}  // namespace

std::string Sides::name(int a, bool upper) { return name_of_side(a, upper); }

Sides::Sides(Options& options, std::vector<SideOption> sides, Words words)
    : sides_(std::move(sides)),
      words_(std::move(words)) {
    for (std::size_t k = 0; k < sides_.size(); ++k) {
        if (sides_[k].words.empty()) continue;
        const int a = static_cast<int>(k / 2);
        const std::string allowed = this->allowed(k);
        std::string help = fmt::format("{} side: {}", name_of_side(a, k % 2 == 1), allowed);
        if (!words_.own.empty()) help += fmt::format(" ({}: {})", words_.own, words_.stands_for);
        if (allowed.find("moving:V") != std::string::npos)
            help += fmt::format("; V is the velocity of the wall along {}", a == 0 ? 'y' : 'x');
        if (words_.temperatures)
            help +=
                "; a mirror or a no-slip wall is insulated, or has the temperature that is "
                "appended, as in mirror@1.5";
        if (!words_.remark.empty()) help += "; " + words_.remark;
        options.text(name_of_side(a, k % 2 == 1), sides_[k].words, help);
    }
}

std::string Sides::allowed(std::size_t k) const {
    std::vector<std::string> words;
    for (const auto& [kind, name] : side_words)
        if (!sides_[k].excluded.contains(kind) && (kind != SideKind::moving || sides_.size() > 2))
            words.emplace_back(name);
    if (!words_.own.empty()) words.push_back(words_.own);
    return either(words);
}

std::vector<std::string> Sides::names() const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < sides_.size(); ++k)
        if (!sides_[k].words.empty())
            names.emplace_back(name_of_side(static_cast<int>(k / 2), k % 2 == 1));
    return names;
}

template <int Dim>
Box<Dim> Sides::box(const Point<Dim>& low, const Point<Dim>& high, const Meanings& meanings) const {
    const auto reader = [&](int a, bool upper) {
        const auto k = static_cast<std::size_t>(2 * a + (upper ? 1 : 0));
        return Reader<Dim>(name(a, upper), sides_[k].words.empty() ? "open" : sides_[k].words, a,
                           sides_[k], meanings, allowed(k), words_.temperatures);
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

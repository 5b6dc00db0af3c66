// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/options.hpp>
#include <spam/neighbors/box.hpp>

#include <map>
#include <string>
#include <vector>

namespace spam {

/// What the sides of a box are, as options say it: --left and --right, in the plane --bottom and --top, in space
/// --front and --back. Each is
///     open, periodic, mirror, no-slip, moving:V or rigid
/// and a wall has its temperature behind it, as in no-slip@1.5, or is insulated; a rigid one has none. V is the
/// velocity of a no-slip wall along itself: along x, of those across x along y.
class Sides {
  public:
    /// Further words, each for one of those above that is only known once all options are: {"moving",
    /// "moving:0.1"}.
    using Meanings = std::map<std::string, std::string>;

    /// The options, with what the sides are where they are not given, in the order above: two for each
    /// direction. A side without words is open and has no option. `more`: further words in --help, as
    /// ", moving (with --speed)". Must live as long as these are read.
    Sides(Options& options, std::vector<std::string> otherwise, const std::string& more = {});
    Sides(const Sides&) = delete;
    Sides& operator=(const Sides&) = delete;

    /// The box between two corners. Throws InputError naming the option where its words make no sense, where
    /// one side of a direction is periodic and the other is not, and for what Box::set_wall() refuses.
    /// In a periodic direction `low` must be 0. Precondition: there are sides for each of the directions.
    template <int Dim>
    Box<Dim> box(const Point<Dim>& low, const Point<Dim>& high,
                 const Meanings& meanings = {}) const;

    /// "left", "right", "bottom", ...
    static std::string name(int a, bool upper);
    /// Of those that are options.
    std::vector<std::string> names() const;

  private:
    std::vector<std::string> words_;
};

extern template Box<1> Sides::box(const Point<1>&, const Point<1>&, const Meanings&) const;
extern template Box<2> Sides::box(const Point<2>&, const Point<2>&, const Meanings&) const;
extern template Box<3> Sides::box(const Point<3>&, const Point<3>&, const Meanings&) const;

}  // namespace spam

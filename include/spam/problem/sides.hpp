// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/options.hpp>
#include <spam/neighbors/box.hpp>

#include <map>
#include <string>
#include <vector>

namespace spam {

/// What an option can make of one side of a box. `moving` is a no-slip wall with a velocity along itself.
enum class SideKind { open, periodic, mirror, no_slip, moving, rigid };

/// One side of a problem's box, as it is where its option is not given, and what it cannot be.
struct SideOption {
    /// Why sides of these kinds make no sense: {{SideKind::open, "would let the gas out"}}.
    using Excluded = std::map<SideKind, std::string>;

    SideOption(const char* otherwise, Excluded without = {})
        : words(otherwise),
          excluded(std::move(without)) {}

    std::string
        words;  ///< empty: it is open and has no option; else what the option says in the end
    Excluded excluded;
};

/// What the sides are, as options say it: --left and --right, in the plane --bottom and --top, in space --front and
/// --back. Each is
///     open, periodic, mirror, no-slip, moving:V or rigid
/// and a mirror or a no-slip wall has the temperature behind it that is appended, as in no-slip@1.5, or is
/// insulated. V is the velocity of a no-slip wall along itself: along x, of those across x along y.
class Sides {
  public:
    /// Further words, each for one of those above that is only known once all options are: {"moving",
    /// "moving:0.1"}.
    using Meanings = std::map<std::string, std::string>;

    /// What --help says of the sides of one problem.
    struct Words {
        /// Whether heat passes walls, so that a temperature has an effect. Else it is refused.
        bool temperatures = true;
        /// A word of the problem's own, and what it stands for: {"moving", "with the speed of --speed"}.
        std::string own = {}, stands_for = {};
        /// A further remark, as "open and rigid need --transport plain".
        std::string remark = {};
    };

    /// The options, in the order above: two for each direction. Must live as long as these are read.
    Sides(Options& options, std::vector<SideOption> sides, Words words);
    Sides(Options& options, std::vector<SideOption> sides) : Sides(options, std::move(sides), {}) {}
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
    /// "open, mirror or rigid", of side k.
    std::string allowed(std::size_t k) const;

    std::vector<SideOption> sides_;
    Words words_;
};

}  // namespace spam

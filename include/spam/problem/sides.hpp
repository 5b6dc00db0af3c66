// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/options.hpp>
#include <spam/neighbors/box.hpp>

#include <array>
#include <string>

namespace spam {

/// What the sides of a box are, as options say it: --left and --right, in the plane --bottom and --top, in space
/// --front and --back. Each is
///     open, periodic, mirror, no-slip or moving:V
/// and a wall has its temperature behind it, as in no-slip@1.5, or is insulated. V is the velocity of a no-slip
/// wall along itself: along x, of those across x along y.
template <int Dim>
class Sides {
  public:
    /// The options, with what they are where they are not given, in the order above. Must live as long as
    /// these are read.
    Sides(Options& options, const std::array<std::string, 2 * Dim>& otherwise);
    Sides(const Sides&) = delete;
    Sides& operator=(const Sides&) = delete;

    /// The box between two corners. Throws InputError naming the option where its words make no sense, where
    /// one side of a direction is periodic and the other is not, and for what Box::set_wall() refuses.
    /// In a periodic direction `low` must be 0.
    Box<Dim> box(const Point<Dim>& low, const Point<Dim>& high) const;

    /// "left", "right", "bottom", ...
    static std::string name(int a, bool upper);

  private:
    std::array<std::string, 2 * Dim> words_;
};

extern template class Sides<1>;
extern template class Sides<2>;
extern template class Sides<3>;

}  // namespace spam

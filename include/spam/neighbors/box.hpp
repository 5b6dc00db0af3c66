// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/core/vec.hpp>
#include <spam/neighbors/wall.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace spam {

/// Free space, periodic space or space between walls, direction by direction. Positions in y are never
/// wrapped; right-hand sides see images of particles across a border (ghosts.hpp), observers take the
/// nearest image of a separation.
///
/// Periods are rounded to 50 bits and positions, where images are made of them, to their last place: then
/// x, L and x +- L up to some periods away are exact, and so is r_ij = -r_ji across a border.
template <int Dim>
class Box {
  public:
    /// Free space in every direction.
    Box() = default;

    /// Periodic in each direction whose length is finite and positive; a length 0 leaves it free.
    explicit Box(const std::array<double, Dim>& lengths) {
        for (std::size_t a = 0; a < Dim; ++a) {
            if (lengths[a] <= 0.0) continue;
            int exponent = 0;
            const double mantissa = std::frexp(lengths[a], &exponent);
            place_[a] = std::ldexp(1.0, exponent - 50);
            length_[a] = std::nearbyint(std::ldexp(mantissa, 50)) * place_[a];
            inverse_[a] = 1.0 / length_[a];
        }
    }

    /// Whether direction `a` (0 to Dim - 1) has a period.
    bool periodic(int a) const { return length_[at(a)] > 0.0; }
    /// Whether any direction has one.
    bool periodic() const {
        for (int a = 0; a < Dim; ++a)
            if (periodic(a)) return true;
        return false;
    }
    /// The period in direction `a`, as rounded; 0 where the direction is free.
    double length(int a) const { return length_[at(a)]; }

    /// The side across direction a, the lower one or the upper one. Throws InputError for a wall across a
    /// periodic direction, one that moves across itself or slips and moves, a temperature that is not above
    /// 0 or of a rigid wall, and a lower wall that is not below the upper one.
    void set_wall(int a, bool upper, const Wall<Dim>& wall);
    /// The side across direction `a`, the lower one or the upper one; WallKind::open where none was set.
    const Wall<Dim>& wall(int a, bool upper) const { return walls_[at(a)][upper ? 1 : 0]; }
    /// Whether one of the two sides across direction `a` is a wall.
    bool walled(int a) const { return !wall(a, false).open() || !wall(a, true).open(); }
    /// Whether any side is.
    bool walled() const {
        for (int a = 0; a < Dim; ++a)
            if (walled(a)) return true;
        return false;
    }
    /// Whether any wall acts by images (Wall::has_images).
    bool has_images() const {
        for (const auto& sides : walls_)
            for (const Wall<Dim>& side : sides)
                if (side.has_images()) return true;
        return false;
    }
    /// Whether energy passes a wall (Wall::passes_energy).
    bool passes_energy() const {
        for (const auto& sides : walls_)
            for (const Wall<Dim>& side : sides)
                if (!side.open() && side.passes_energy()) return true;
        return false;
    }
    /// The largest speed of a wall along itself; 0 where none moves.
    double fastest_wall() const {
        double fastest = 0.0;
        for (const auto& sides : walls_)
            for (const Wall<Dim>& side : sides) fastest = std::max(fastest, side.velocity.norm());
        return fastest;
    }
    /// The same space with its walls taken away.
    Box without_walls() const {
        Box box = *this;
        box.walls_ = {};
        return box;
    }
    /// The same space without the walls that have no images: what neighbours are looked for in.
    Box of_images() const {
        Box box = *this;
        for (auto& sides : box.walls_)
            for (Wall<Dim>& side : sides)
                if (!side.has_images()) side = {};
        return box;
    }
    /// "walls: mirror at x = 0; no-slip, T = 1.5 at y = 20"; empty where there are none.
    std::string describe_walls() const;
    /// The last place of the period, a power of two; 0 where the direction is free.
    double last_place(int a) const { return place_[at(a)]; }

    /// The image of x inside [0, L) (a free coordinate is returned as it is).
    double wrap(int a, double x) const {
        const double w = x - length_[at(a)] * std::floor(x * inverse_[at(a)]);
        return periodic(a) && w >= length_[at(a)] ? 0.0 : w;
    }

    /// All positions (Dim x N) wrapped.
    Points<Dim> wrapped(Points<Dim> position) const {
        for (int a = 0; a < Dim; ++a)
            if (periodic(a))
                for (Eigen::Index i = 0; i < position.cols(); ++i)
                    position(a, i) = wrap(a, position(a, i));
        return position;
    }

    /// Smallest image of a separation of two wrapped coordinates, |s| < L. No branch: in a free
    /// direction zero is subtracted. Exactly antisymmetric.
    template <class T>
    T nearest_image(int a, const T& s) const {
        return s - T(length_[at(a)]) * nearest_integer(s * T(inverse_[at(a)]));
    }

    /// The nearest image of r, a difference of two positions.
    Point<Dim> nearest(Point<Dim> r) const {
        for (int a = 0; a < Dim; ++a)
            if (periodic(a)) r[a] = nearest_image(a, r[a]);
        return r;
    }
    /// The nearest image of x_i - x_j, of any two positions; exactly x_i - x_j in free directions.
    Point<Dim> separation(const Point<Dim>& x_i, const Point<Dim>& x_j) const {
        Point<Dim> r;
        for (int a = 0; a < Dim; ++a)
            r[a] =
                periodic(a) ? nearest_image(a, wrap(a, x_i[a]) - wrap(a, x_j[a])) : x_i[a] - x_j[a];
        return r;
    }

  private:
    static constexpr std::size_t at(int a) { return static_cast<std::size_t>(a); }
    std::array<double, Dim> length_{};
    std::array<double, Dim> inverse_{}, place_{};
    std::array<std::array<Wall<Dim>, 2>, Dim> walls_{};
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// Plane regions to fill with particles.
#pragma once

#include <spam/core/state.hpp>

#include <string>
#include <vector>

namespace relaxation {

using namespace spam;

/// What a closed polygon surrounds.
class Region {
  public:
    /// `polygon`: 2 x M corners in order, M >= 3, in either sense. Throws InputError where it has no
    /// area, less than a thousandth of that of the square around it, or crosses or touches itself.
    explicit Region(Points<2> polygon);

    /// Corners, counterclockwise.
    const Points<2>& polygon() const { return polygon_; }
    double area() const;
    bool contains(const Point<2>& r) const;
    /// From the border, whichever side.
    double distance(const Point<2>& r) const;

    /// As large as `area`, its centroid at the origin: positions there are those here times scale(),
    /// less shift().
    Region of_area(double area) const;
    double scale() const { return scale_; }
    Point<2> shift() const { return shift_; }

  private:
    void sort_sides();
    std::size_t band(double y) const;

    Points<2> polygon_;
    /// Sides by their corners, those that enter a band of heights: for contains().
    std::vector<std::vector<Eigen::Index>> bands_;
    double low_ = 0.0, band_height_ = 1.0;
    double scale_ = 1.0;
    Point<2> shift_ = Point<2>::Zero();
};

/// r(theta) = 1 + depth (cos(lobes theta) + sin(2 theta)/2), 720 corners: no symmetry.
Region lobed_region(int lobes, double depth);

/// Corners from a file, a line "x,y" (or "x y") each. Names of columns may stand above them; lines that
/// are empty or begin with # are passed over. Throws InputError naming file and line.
Region region_from_file(const std::string& path);

/// N places in the region of area N: anywhere.
Points<2> random_places(const Region& region, int particles, int seed);
/// N sites of a triangular lattice with one site per area, moved until as many are inside. Throws
/// InputError where that does not come out.
Points<2> lattice_places(const Region& region, int particles, int seed);

}  // namespace relaxation

// SPDX-License-Identifier: GPL-3.0-or-later
#include "region.hpp"

#include "../shared_options.hpp"
#include <spam/core/error.hpp>
#include <spam/io/csv.hpp>
#include <spam/io/text_file.hpp>
#include <spam/setup/drawn.hpp>

// Boost 1.74 includes some of its own headers by names that it calls former ones, and would round corners to a grid
// of integers before it looks for crossings.
#define BOOST_ALLOW_DEPRECATED_HEADERS
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/centroid.hpp>
#include <boost/geometry/algorithms/is_valid.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace relaxation {

namespace {

namespace geometry = boost::geometry;
using Corner = geometry::model::d2::point_xy<double>;
using Ring = geometry::model::ring<Corner, false, false>;  // counterclockwise, no corner twice

Ring ring_of(const Points<2>& polygon) {
    Ring ring;
    for (const auto& corner : polygon.colwise()) ring.emplace_back(corner.x(), corner.y());
    return ring;
}

/// A thinner shape leaves random_places() next to no chance, and a wall around it no end.
constexpr double least_part = 1e-3;

/// Names of columns: all words begin with a letter and none is what some write for a number.
bool is_header(const std::vector<std::string>& words) {
    return std::all_of(words.begin(), words.end(), [](const std::string& word) {
        double value = 0.0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
        return !word.empty() && std::isalpha(static_cast<unsigned char>(word.front())) &&
               read.ec != std::errc{} && read.ptr == word.data();
    });
}

}  // namespace

Region::Region(Points<2> polygon) : polygon_(std::move(polygon)) {
    if (polygon_.cols() < 3 || !polygon_.allFinite())
        throw InputError("outline: these corners surround no area; give three or more in order");
    Ring ring = ring_of(polygon_);
    if (geometry::area(ring) < 0.0) {
        polygon_ = polygon_.rowwise().reverse().eval();
        ring = ring_of(polygon_);
    }
    std::string crossing;
    const bool simple = geometry::is_valid(ring, crossing);
    const double area = geometry::area(ring);
    if (!std::isfinite(area) || area == 0.0)
        throw InputError("outline: these corners surround no area; give three or more in order");
    const double length =
        (polygon_.rowwise().maxCoeff() - polygon_.rowwise().minCoeff()).maxCoeff();
    if (!(area / length >= least_part * length))
        refuse(
            "outline: a shape of length {:g} and area {:g} is too thin; let it fill a "
            "thousandth of the square around it",
            length, area);
    if (!simple)
        refuse(
            "outline: the border crosses or touches itself: {}; give corners in order "
            "around one region",
            crossing.substr(0, crossing.find(';')));
    sort_sides();
}

double Region::area() const { return geometry::area(ring_of(polygon_)); }

std::size_t Region::band(double y) const {
    const double at = std::clamp((y - low_) / band_height_, 0.0, double(bands_.size()) - 1.0);
    return static_cast<std::size_t>(at);
}

void Region::sort_sides() {
    const auto bands = static_cast<std::size_t>(std::min<Eigen::Index>(512, polygon_.cols()));
    low_ = polygon_.row(1).minCoeff();
    band_height_ = (polygon_.row(1).maxCoeff() - low_) / static_cast<double>(bands);
    bands_.assign(bands, {});
    for (Eigen::Index k = 0; k < polygon_.cols(); ++k) {
        const double a = polygon_(1, k), b = polygon_(1, (k + 1) % polygon_.cols());
        for (std::size_t n = band(std::min(a, b)); n <= band(std::max(a, b)); ++n)
            bands_[n].push_back(k);
    }
}

bool Region::contains(const Point<2>& r) const {
    if (!r.allFinite()) return false;
    bool inside = false;
    for (const Eigen::Index k : bands_[band(r.y())]) {
        const Point<2> a = polygon_.col(k), b = polygon_.col((k + 1) % polygon_.cols());
        if ((a.y() > r.y()) == (b.y() > r.y())) continue;
        if (r.x() < a.x() + (r.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    return inside;
}

double Region::distance(const Point<2>& r) const {
    double least = HUGE_VAL;
    for (Eigen::Index k = 0; k < polygon_.cols(); ++k) {
        const Point<2> a = polygon_.col(k), side = polygon_.col((k + 1) % polygon_.cols()) - a;
        const double along = std::clamp((r - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
        least = std::min(least, (a + along * side - r).squaredNorm());
    }
    return std::sqrt(least);
}

Region Region::of_area(double area) const {
    Region other = *this;
    other.scale_ = std::sqrt(area / this->area());
    other.polygon_ *= other.scale_;
    Corner centroid(0.0, 0.0);
    geometry::centroid(ring_of(other.polygon_), centroid);
    other.shift_ = {centroid.x(), centroid.y()};
    other.polygon_.colwise() -= other.shift_;
    other.sort_sides();
    return other;
}

Region lobed_region(int lobes, double depth) {
    Points<2> polygon(2, 720);
    for (Eigen::Index k = 0; k < polygon.cols(); ++k) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / 720.0;
        const double r = 1.0 + depth * (std::cos(lobes * angle) + 0.5 * std::sin(2.0 * angle));
        polygon.col(k) = r * Point<2>(std::cos(angle), std::sin(angle));
    }
    return Region(polygon);
}

Region region_from_file(const std::string& path) {
    CsvReader rows(
        text_file(path, "outline", "a file with a line x,y a corner"), path,
        {.option = "outline", .remedy = "write a corner as two numbers, x,y", .free = true});
    std::vector<Point<2>> corners;
    bool first = true;
    while (rows.next()) {
        if (std::exchange(first, false) && is_header(rows.cells())) continue;
        if (rows.cells().size() != 2)
            rows.refuse(fmt::format("has {} cells in place of 2", rows.cells().size()));
        const Point<2> corner(rows.number(0), rows.number(1));
        if (corners.empty() || corner != corners.back()) corners.push_back(corner);
    }
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3)
        refuse("outline: '{}' has {} corners; give a line x,y for each of three or more", path,
               corners.size());
    if (corners.size() > 20000)
        refuse("outline: '{}' has {} corners; 20000 are enough", path, corners.size());
    Points<2> polygon(2, static_cast<Eigen::Index>(corners.size()));
    for (std::size_t k = 0; k < corners.size(); ++k)
        polygon.col(static_cast<Eigen::Index>(k)) = corners[k];
    return Region(polygon);
}

Points<2> random_places(const Region& region, int particles, int seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const Point<2> low = region.polygon().rowwise().minCoeff();
    const Point<2> size = region.polygon().rowwise().maxCoeff() - low;
    Points<2> places(2, particles);
    for (auto place : places.colwise()) {
        // Region fills a thousandth of its box or more: e^-100 is the chance that this does not do
        int draws = 0;
        do {
            if (++draws > 100000)
                throw InputError(
                    "outline: no place inside was found; give a shape that is less thin");
            place.x() = low.x() + drawn(random) * size.x();
            place.y() = low.y() + drawn(random) * size.y();
        } while (!region.contains(place));
    }
    return places;
}

Points<2> lattice_places(const Region& region, int particles, int seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const double spacing = std::sqrt(std::sqrt(4.0 / 3.0)), row = spacing * std::sqrt(0.75);
    const Point<2> low = region.polygon().rowwise().minCoeff();
    const Point<2> high = region.polygon().rowwise().maxCoeff();
    for (int attempt = 0; attempt < 2000; ++attempt) {
        const Point<2> shift(drawn(random) * spacing, drawn(random) * 2.0 * row);
        std::vector<Point<2>> inside;
        int number = 0;
        for (double y = low.y() - shift.y(); y < high.y(); y += row, ++number)
            for (double x = low.x() - shift.x() + (number % 2) * 0.5 * spacing; x < high.x();
                 x += spacing)
                if (region.contains({x, y})) inside.emplace_back(x, y);
        if (static_cast<int>(inside.size()) != particles) continue;
        Points<2> places(2, particles);
        for (std::size_t k = 0; k < inside.size(); ++k)
            places.col(static_cast<Eigen::Index>(k)) = inside[k];
        return places;
    }
    refuse(
        "particles: no lattice with {} sites inside was found; give another number, or "
        "--start random",
        particles);
}

}  // namespace relaxation

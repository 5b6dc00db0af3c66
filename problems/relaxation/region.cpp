// SPDX-License-Identifier: GPL-3.0-or-later
#include "region.hpp"

#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/io/text_file.hpp>
#include <spam/setup/drawn.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace relaxation {

using spam::number_in;

namespace {

double cross(const Point<2>& a, const Point<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

double signed_area(const Points<2>& polygon) {
    double twice = 0.0;
    for (Eigen::Index k = 0; k < polygon.cols(); ++k)
        twice += cross(polygon.col(k), polygon.col((k + 1) % polygon.cols()));
    return 0.5 * twice;
}

Point<2> centroid(const Points<2>& polygon) {
    Point<2> sum = Point<2>::Zero();
    for (Eigen::Index k = 0; k < polygon.cols(); ++k) {
        const Point<2> a = polygon.col(k), b = polygon.col((k + 1) % polygon.cols());
        sum += cross(a, b) * (a + b);
    }
    return sum / (6.0 * signed_area(polygon));
}

/// Whether the sides from corner j and from corner k meet without being neighbours.
bool cross_each_other(const Points<2>& polygon, Eigen::Index j, Eigen::Index k) {
    const Eigen::Index n = polygon.cols();
    if (k == j || (j + 1) % n == k || (k + 1) % n == j) return false;
    const Point<2> a = polygon.col(j), b = polygon.col((j + 1) % n);
    const Point<2> c = polygon.col(k), d = polygon.col((k + 1) % n);
    const auto side = [](const Point<2>& p, const Point<2>& q, const Point<2>& r) {
        return cross(q - p, r - p) > 0.0;
    };
    return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

/// A thinner shape leaves random_places() next to no chance, and a wall around it no end.
constexpr double least_part = 1e-3;

/// Between blanks, or the first comma: "x,y", "x y". A second comma stays in its word, which then is no
/// number.
std::vector<std::string> words_of(std::string line) {
    if (const auto comma = line.find(','); comma != std::string::npos) line[comma] = ' ';
    std::istringstream in(line);
    return {std::istream_iterator<std::string>(in), {}};
}

/// Names of columns: all words begin with a letter and none is what some write for a number.
bool is_header(const std::vector<std::string>& words) {
    return std::all_of(words.begin(), words.end(), [](const std::string& word) {
        double value = 0.0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
        return std::isalpha(static_cast<unsigned char>(word.front())) && read.ec != std::errc{} &&
               read.ptr == word.data();
    });
}

}  // namespace

Region::Region(Points<2> polygon) : polygon_(std::move(polygon)) {
    const double area = polygon_.cols() < 3 ? 0.0 : signed_area(polygon_);
    if (!std::isfinite(area) || area == 0.0)
        throw InputError("outline: these corners surround no area; give three or more in order");
    const double length =
        (polygon_.rowwise().maxCoeff() - polygon_.rowwise().minCoeff()).maxCoeff();
    if (!(std::abs(area) / length >= least_part * length))
        throw InputError(
            fmt::format("outline: a shape of length {:g} and area {:g} is too thin; let it fill a "
                        "thousandth of the square around it",
                        length, std::abs(area)));
    if (area < 0.0) polygon_ = polygon_.rowwise().reverse().eval();
    for (Eigen::Index j = 0; j < polygon_.cols(); ++j)
        for (Eigen::Index k = j + 1; k < polygon_.cols(); ++k)
            if (cross_each_other(polygon_, j, k))
                throw InputError(
                    fmt::format("outline: the side at ({:g}, {:g}) crosses the one at ({:g}, "
                                "{:g}); give corners "
                                "in order around one region",
                                polygon_(0, j), polygon_(1, j), polygon_(0, k), polygon_(1, k)));
    sort_sides();
}

double Region::area() const { return signed_area(polygon_); }

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

Point<2> Region::nearest_on_border(const Point<2>& r) const {
    double least = HUGE_VAL;
    Point<2> nearest = polygon_.col(0);
    for (Eigen::Index k = 0; k < polygon_.cols(); ++k) {
        const Point<2> a = polygon_.col(k), side = polygon_.col((k + 1) % polygon_.cols()) - a;
        const double along = std::clamp((r - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
        const Point<2> at = a + along * side;
        if ((r - at).squaredNorm() >= least) continue;
        least = (r - at).squaredNorm();
        nearest = at;
    }
    return nearest;
}

Region Region::of_area(double area) const {
    Region other = *this;
    other.scale_ = std::sqrt(area / this->area());
    other.polygon_ *= other.scale_;
    other.shift_ = centroid(other.polygon_);
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
    std::istringstream in(text_file(path, "outline", "a file with a line x,y a corner"));
    std::vector<Point<2>> corners;
    std::string line;
    bool first = true;
    for (int number = 1; std::getline(in, line); ++number) {
        const auto words = words_of(line);
        if (words.empty() || words[0].front() == '#') continue;
        if (std::exchange(first, false) && is_header(words)) continue;
        const auto x = number_in(words[0]);
        const auto y = words.size() == 2 ? number_in(words[1]) : std::nullopt;
        if (!x || !y)
            throw InputError(fmt::format(
                "outline: line {} of '{}' is no corner; write two numbers, x,y", number, path));
        const Point<2> corner(*x, *y);
        if (corners.empty() || corner != corners.back()) corners.push_back(corner);
    }
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3)
        throw InputError(
            fmt::format("outline: '{}' has {} corners; give a line x,y for each of three or more",
                        path, corners.size()));
    if (corners.size() > 20000)
        throw InputError(
            fmt::format("outline: '{}' has {} corners; 20000 are enough", path, corners.size()));
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
    throw InputError(
        fmt::format("particles: no lattice with {} sites inside was found; give another number, or "
                    "--start random",
                    particles));
}

}  // namespace relaxation

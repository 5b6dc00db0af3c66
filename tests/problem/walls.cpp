// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the problem relaxation: regions, and walls that stand for evenly spread matter outside.
#include "relaxation/quality.hpp"
#include "relaxation/wall.hpp"
#include "support/process.hpp"
#include <spam/core/error.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace relaxation;

namespace {

constexpr double range = 1.5;

/// Straight sides, sharp corners inwards and outwards.
Region arrow() {
    Points<2> corners(2, 5);
    corners << -5, 6, 1, 6, -5,  //
        -4, -5, 0, 5, 3;
    return Region(corners);
}

std::vector<Point<2>> places(const Region& region) {
    std::mt19937_64 random(3);
    const Point<2> low = region.polygon().rowwise().minCoeff();
    const Point<2> size = region.polygon().rowwise().maxCoeff() - low;
    std::vector<Point<2>> all;
    for (int k = 0; k < 300; ++k) {
        const auto drawn = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
        Point<2> r(drawn(), drawn());
        all.emplace_back(low + (1.4 * r - Point<2>::Constant(0.2)).cwiseProduct(size));
    }
    return all;
}

/// The largest |F + grad Phi| of forces of one wall and the energy of another.
double force_error(const Region& region, const OuterMatter& of_force,
                   const OuterMatter& of_energy) {
    double worst = 0.0;
    const double d = 1e-4;
    for (const Point<2>& r : places(region)) {
        if (region.distance(r) < 0.02) continue;  // quadrature along the nearest piece
        Point<2> slope;
        for (int a = 0; a < 2; ++a) {
            Point<2> step = Point<2>::Zero();
            step[a] = d;
            slope[a] = (8.0 * (of_energy.energy(r + step) - of_energy.energy(r - step)) -
                        (of_energy.energy(r + 2.0 * step) - of_energy.energy(r - 2.0 * step))) /
                       (12.0 * d);
        }
        worst = std::max(worst, (of_force.force(r) + slope).norm());
    }
    return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(forces_of_a_wall_are_minus_the_slope_of_its_energy) {
    for (const Region& region : {arrow(), lobed_region(3, 0.2).of_area(100.0)}) {
        const OuterMatter wall(region, range);
        BOOST_TEST(force_error(region, wall, wall) < 1e-5);
        BOOST_TEST(force_error(region, wall, OuterMatter(region, 1.1 * range)) > 1e-2);
    }
}

BOOST_AUTO_TEST_CASE(
    what_pulls_back_is_a_spring_at_a_straight_border_and_does_not_jump_between_two) {
    Points<2> corners(2, 8);
    corners << -500, 500, 500, 2, 2, -2, -2, -500,  //
        -500, -500, 500, 500, 0, 0, 500, 500;       // a cleft of width 4
    const Region region(corners);
    const OuterMatter wall(region, range);
    for (const double d : {1e-6, 0.03, 0.4, 2.0}) {
        const double spring =
            wall.energy({100.0, -500.0 - d}) - wall.weight_outside({100.0, -500.0 - d});
        BOOST_TEST(std::abs(spring - 0.5 * d * d) < 1e-5 * d * d + 1e-15);
    }
    const Point<2> middle(0.0, 250.0), aside(1e-7, 0.0);
    BOOST_TEST((wall.force(middle + aside) - wall.force(middle - aside)).norm() < 1e-5);
    // beside a corner and in line with a side the integral along that side is finite
    const Point<2> in_line(500.0, 503.0);
    BOOST_TEST((wall.force(in_line + aside) - wall.force(in_line - aside)).norm() < 1e-5);
    BOOST_TEST((wall.force(in_line + 1e-3 * aside) - wall.force(in_line)).norm() < 1e-5);
    BOOST_TEST(wall.force({2.0, 250.0}).allFinite());  // on a side
}

BOOST_AUTO_TEST_CASE(a_wall_is_the_weight_of_what_is_outside) {
    const Region region = arrow();
    const OuterMatter wall(region, range);
    const Lucy<2> w(range);
    for (const Point<2>& r : places(region)) {
        const double found = wall.weight_outside(r);
        double sum = 0.0;  // by points outside
        const int n = 120;
        const double cell = 2.0 * range / n;
        for (int x = 0; x < n; ++x)
            for (int y = 0; y < n; ++y) {
                const Point<2> s((x + 0.5) * cell - range, (y + 0.5) * cell - range);
                if (!region.contains(r + s)) sum += w.value(s.norm()) * cell * cell;
            }
        BOOST_TEST(std::abs(found - sum) < 0.01);
        if (region.distance(r) > range)
            BOOST_TEST(std::abs(found - (region.contains(r) ? 0.0 : 1.0)) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(a_border_is_smooth_where_half_of_a_weight_is_outside) {
    const auto least = [](const Region& region) {
        return OuterMatter(region, range).least_weight_on_border();
    };
    BOOST_TEST(std::abs(least(lobed_region(1, 0.0).of_area(1e4)) - 0.5) < 0.03);
    BOOST_TEST(std::abs(least(lobed_region(3, 0.2).of_area(400.0)) - 0.5) < 0.1);
    BOOST_TEST(least(arrow()) < 0.3);                                // the notch
    BOOST_TEST(least(lobed_region(50, 0.6).of_area(400.0)) < 0.05);  // gaps between lobes
}

BOOST_AUTO_TEST_CASE(nearest_neighbours_are_those_of_all_pairs) {
    Points<2> x = 3.0 * random_places(lobed_region(3, 0.2).of_area(100.0), 100, 1);
    x.col(7).setConstant(500.0);  // far off
    double sum = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        double least = HUGE_VAL;
        for (Eigen::Index j = 0; j < x.cols(); ++j)
            if (j != i) least = std::min(least, (x.col(j) - x.col(i)).norm());
        sum += least;
    }
    BOOST_TEST(std::abs(mean_nearest(x) - sum / 100.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_region_knows_its_inside) {
    const Region region = arrow();
    BOOST_TEST(region.contains({-2.0, 0.0}));
    BOOST_TEST(!region.contains({4.0, 0.0}));  // in the notch
    BOOST_TEST(!region.contains({std::nan(""), 0.0}));
    BOOST_TEST(std::abs(region.distance({-4.0, 0.0}) - 1.0) < 1e-14);
    const Region large = region.of_area(400.0);
    BOOST_TEST(std::abs(large.area() - 400.0) < 1e-10);
    for (const Point<2>& r : places(region))
        BOOST_TEST(region.contains(r) == large.contains(r * large.scale() - large.shift()));
    Points<2> clockwise = region.polygon().rowwise().reverse();
    BOOST_TEST(Region(clockwise).area() == region.area());
}

BOOST_AUTO_TEST_CASE(places_are_inside_and_as_many_as_wanted) {
    const Region region = lobed_region(5, 0.3).of_area(150.0);
    for (const Points<2>& places :
         {random_places(region, 150, 2), lattice_places(region, 150, 2)}) {
        BOOST_TEST(places.cols() == 150);
        for (Eigen::Index i = 0; i < places.cols(); ++i) BOOST_TEST(region.contains(places.col(i)));
    }
}

BOOST_AUTO_TEST_CASE(outlines_that_are_none_are_refused) {
    const spam::test::Scratch folder;
    const auto refused = [&](const std::string& text, const std::string& word) {
        folder.write("outline.csv", text);
        BOOST_CHECK_EXCEPTION(region_from_file(folder / "outline.csv"), InputError,
                              [&](const InputError& error) {
                                  return std::string(error.what()).find(word) != std::string::npos;
                              });
    };
    refused("", "has 0 corners");
    refused("x,y\n# none\n", "has 0 corners");
    refused("0,0\n1,0\n", "has 2 corners");
    refused("0,0\n1,0\n2,0\n", "no area");
    refused("0,0\n1,0\n2,2\n2,here\n", "line 4");
    for (const char* line : {"x,y", "x0,1", "nan,0", "0", "0,1,2", "0 1 2", "0,1x", "0,,1", "0;1"})
        refused(std::string("x,y\n0,0\n1,0\n") + line + "\n1,1\n0,1\n", "line 4");
    for (const char* line : {"nan,0", "inf inf", "x0,1", "x,0"})
        refused(std::string(line) + "\n0,0\n1,0\n1,1\n", "line 1");
    BOOST_CHECK_EXCEPTION(region_from_file(folder.path()), InputError, [](const InputError& error) {
        return std::string(error.what()).find("cannot be read") != std::string::npos;
    });
    refused("0,0\n2,2\n2,0\n0,1\n", "crosses");
    refused("0,0\n1000,1000\n1000,1000.0001\n", "too thin");
    refused("0,0\n1e8,0\n1e8,1e-8\n0,1e-8\n", "too thin");
    refused("0,0\n1,inf\n1,0\n", "line 2");
    folder.write("outline.csv", "\xEF\xBB\xBFx,y\n# a square, closed\n0,0\n2 0\n2,2\n0,2\n0,0\n");
    const Region square = region_from_file(folder / "outline.csv");
    BOOST_TEST(square.area() == 4.0);
    BOOST_TEST(square.polygon().cols() == 4);
}

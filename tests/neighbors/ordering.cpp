// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/connected_parts.hpp>
#include <spam/neighbors/strip_sort.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <numeric>
#include <random>

using namespace spam;

namespace {

/// Mean distance between particles whose slots follow each other, and the largest one.
template <int Dim>
std::array<double, 2> steps(const Points<Dim>& x, std::span<const std::uint32_t> order) {
    double sum = 0.0, largest = 0.0;
    for (std::size_t k = 1; k < order.size(); ++k) {
        const double step = (x.col(order[k]) - x.col(order[k - 1])).norm();
        sum += step;
        largest = std::max(largest, step);
    }
    return {sum / static_cast<double>(order.size() - 1), largest};
}

template <int Dim>
void neighbours_in_memory(Eigen::Index n, double size) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(-0.5 * size, 0.5 * size);
    Points<Dim> x(Dim, n);
    for (auto& c : x.reshaped()) c = u(random);
    StripSort<Dim> strips;
    strips.build(x, {});
    std::vector<std::uint32_t> order(strips.order().begin(), strips.order().end());
    const auto [mean, largest] = steps(x, order);
    const double spacing = size / std::pow(static_cast<double>(n), 1.0 / Dim);
    BOOST_TEST(mean < 1.5 * spacing);
    BOOST_TEST(largest < 8.0 * spacing);  // strips join at their ends: no step across the body
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < order.size(); ++k) BOOST_TEST(order[k] == k);
    BOOST_TEST(steps(x, order)[0] > 5.0 * mean);  // the numbers as drawn
}

}  // namespace

BOOST_AUTO_TEST_CASE(slots_that_follow_each_other_are_neighbours) {
    neighbours_in_memory<1>(500, 500.0);
    neighbours_in_memory<2>(2000, 40.0);
    neighbours_in_memory<3>(8000, 20.0);
}

// Few in a bin are sorted in another way than many.
BOOST_AUTO_TEST_CASE(ties_keep_the_lower_number_first) {
    for (const Eigen::Index n : {40, 400}) {
        const Points<2> same = Points<2>::Constant(2, n, 3.0);
        StripSort<2> strips;
        strips.build(same, {});
        BOOST_TEST(std::is_sorted(strips.order().begin(), strips.order().end()));
    }
}

BOOST_AUTO_TEST_CASE(bodies_are_connected_parts) {
    Points<2> x(2, 7);
    x << 0, 10, 1, 11, 2, 12, 30,  //
        0, 0, 0, 0, 0, 0, 0;
    const auto body = connected_parts<2>(x, 1.2, {});
    const std::vector<std::int32_t> expected{0, 1, 0, 1, 0, 1, 2};
    BOOST_TEST(body == expected, boost::test_tools::per_element());
    // Across a periodic boundary the last joins the first.
    const auto joined = connected_parts<2>(x, 1.2, Box<2>({31.0, 0.0}));
    BOOST_TEST(joined[6] == 0);
}

// Periods that are no whole number of reaches; places next to the border, which rounding may take for the
// other side.
BOOST_AUTO_TEST_CASE(bodies_in_boxes_of_any_length) {
    std::size_t apart = 0, cut = 0;
    for (int k = 0; k < 1000; ++k) {
        const double length = 5.0 + 0.013 * k;
        const Box<1> box({length});
        Points<1> x(1, 2);
        for (double at = 0.0; at < length; at += 0.09) {
            x << at, at + 0.99;
            apart += connected_parts<1>(x, 1.0, box).back() == 0 ? 0 : 1;
        }
        for (double last = length; last > length * (1.0 - 1e-15);) {
            last = std::nextafter(last, 0.0);
            x << last, 0.1;
            cut += connected_parts<1>(x, 1.0, box).back() == 0 ? 0 : 1;
        }
    }
    BOOST_TEST(apart == 0U);
    BOOST_TEST(cut == 0U);
}

BOOST_AUTO_TEST_CASE(who_is_as_far_as_the_reach_is_not_connected) {
    const Points<2> x = square_lattice<2>({4, 3});
    for (const Box<2>& box : {Box<2>(), Box<2>({4.0, 3.0})}) {
        BOOST_TEST(connected_parts<2>(x, 1.0, box).back() == 11);
        BOOST_TEST(connected_parts<2>(x, 1.0 + 1e-12, box).back() == 0);
    }
}

BOOST_AUTO_TEST_CASE(bodies_of_random_particles_by_all_pairs) {
    std::mt19937_64 random(7);
    const auto compare = [&]<int Dim>(const Points<Dim>& x, const Box<Dim>& box) {
        const auto n = static_cast<std::size_t>(x.cols());
        const Points<Dim> in = box.wrapped(x);
        // The lowest number spreads until nothing changes.
        std::vector<std::size_t> lowest(n);
        std::iota(lowest.begin(), lowest.end(), 0U);
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) {
                    double r2 = 0.0;
                    for (int a = 0; a < Dim; ++a) {
                        const double s =
                            box.nearest_image(a, in(a, static_cast<Eigen::Index>(i)) -
                                                     in(a, static_cast<Eigen::Index>(j)));
                        r2 += s * s;
                    }
                    if (r2 < 1.0 && lowest[j] < lowest[i]) lowest[i] = lowest[j], changed = true;
                }
        }
        std::vector<std::int32_t> expected(n);
        std::int32_t bodies = 0;
        for (std::size_t i = 0; i < n; ++i)
            expected[i] = lowest[i] == i ? bodies++ : expected[lowest[i]];
        if (n > 10) BOOST_TEST(bodies > 1);
        BOOST_TEST(connected_parts<Dim>(x, 1.0, box) == expected, boost::test_tools::per_element());
    };
    const auto drawn_in = [&]<int Dim>(Points<Dim> x, double size) {
        std::uniform_real_distribution<double> u(-0.5 * size, 0.5 * size);
        for (auto& c : x.reshaped()) c = u(random);
        return x;
    };
    for (int round = 0; round < 5; ++round) {
        compare(drawn_in(Points<1>(1, 40), 50.0), Box<1>());
        compare(drawn_in(Points<1>(1, 40), 90.0), Box<1>({50.0}));
        compare(drawn_in(Points<2>(2, 150), 12.0), Box<2>());
        compare(drawn_in(Points<2>(2, 150), 30.0), Box<2>({12.0, 0.0}));
        compare(drawn_in(Points<2>(2, 6), 30.0), Box<2>({2.5, 1.5}));  // of two cells, of one
        compare(drawn_in(Points<3>(3, 200), 7.0), Box<3>());
        compare(drawn_in(Points<3>(3, 200), 9.0), Box<3>({7.0, 7.0, 7.0}));
        Points<2> crowds =
            drawn_in(Points<2>(2, 200), 0.8);  // each nearly all one another's neighbours
        crowds.rightCols(100).row(0).array() += 1.85;
        compare(crowds, Box<2>());
        Points<2> flung = drawn_in(Points<2>(2, 100), 8.0);
        flung.leftCols(3).array() *= 1e18;
        compare(flung, Box<2>());
    }
}

BOOST_AUTO_TEST_CASE(particles_remember_their_ids) {
    const auto points = triangular_hexagon(4);
    const auto particles = make_particles<2>(points, 2.0);
    BOOST_TEST(particles.size() == 61U);
    BOOST_TEST(particles.bodies() == 1);
    for (std::size_t k = 0; k < particles.size(); ++k)
        BOOST_TEST((particles.reference_position.col(static_cast<Eigen::Index>(k)) ==
                    points.col(particles.id[k])));
}

BOOST_AUTO_TEST_CASE(hexagon_of_the_paper) {
    for (const int n : {0, 1, 2, 8}) {
        const auto points = triangular_hexagon(n);
        BOOST_TEST(points.cols() == 1 + 3 * n + 3 * n * n);
        BOOST_TEST(points.rowwise().sum().norm() < 1e-12);
        if (n > 0) BOOST_TEST(std::abs(points.colwise().norm().maxCoeff() - n) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(square_lattices) {
    BOOST_TEST(square_lattice<1>({5}).cols() == 5);
    BOOST_TEST(square_lattice<3>({2, 3, 4}, 0.5).cols() == 24);
    BOOST_TEST(square_lattice<3>({2, 3, 4}, 0.5).row(2).maxCoeff() == 1.5);
    BOOST_TEST(triangular_block(4, 6).cols() == 24);
}

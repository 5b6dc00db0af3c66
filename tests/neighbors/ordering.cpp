// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/connected_parts.hpp>
#include <spam/neighbors/strip_order.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>

using namespace spam;

BOOST_AUTO_TEST_CASE(strip_order_is_a_permutation_in_strips) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(-5.0, 5.0);
    Points<2> x(2, 500);
    for (auto& c : x.reshaped()) c = u(random);
    auto order = strip_order<2>(x, 1.5);
    for (std::size_t k = 1; k < order.size(); ++k) {
        const double a = std::floor(x(0, order[k - 1]) / 1.5), b = std::floor(x(0, order[k]) / 1.5);
        BOOST_TEST((a < b || (a == b && x(1, order[k - 1]) <= x(1, order[k]))));
    }
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < order.size(); ++k) BOOST_TEST(order[k] == k);
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

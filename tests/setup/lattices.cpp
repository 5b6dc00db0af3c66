// SPDX-License-Identifier: GPL-3.0-or-later
// Lattices in space, and what is cut out of them.
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <tuple>

using namespace spam;

BOOST_AUTO_TEST_CASE(cubic_lattices_have_their_neighbours) {
    // Of a site inside: how many at distance 1, and no nearer one.
    for (const auto& [lattice, neighbours, in_cell] :
         {std::tuple{CubicLattice::sc, 6, 1}, std::tuple{CubicLattice::fcc, 12, 4},
          std::tuple{CubicLattice::bcc, 8, 2}}) {
        const Points<3> points = 0.5 * cubic_lattice(lattice, {6, 6, 6}, 2.0);
        BOOST_TEST(points.cols() == 216 * in_cell);
        const double middle = 3.0 * cubic_edge(lattice);
        int near = 0;
        for (const auto& x : points.colwise()) {
            const double r = (x.array() - middle).matrix().norm();
            near += r > 1e-9 && r < 1.0 + 1e-9 ? 1 : 0;
            BOOST_TEST((r < 1e-9 || r > 1.0 - 1e-9));
        }
        BOOST_TEST(near == neighbours);
        // A fcc ball of radius 4 has 381 sites.
        const Points<3> about = points.array() - middle;
        if (lattice == CubicLattice::fcc) BOOST_TEST(ball_of(about, 4.0).cols() == 381);
        BOOST_TEST(cylinder_of(about, 0.0).cols() == 6);
    }
}

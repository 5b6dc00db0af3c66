// SPDX-License-Identifier: GPL-3.0-or-later
// Finite differences beside the particles of rayleigh_benard: the layer at rest is exact, cells converge with
// order two, and small rolls begin to grow where linear theory says.
#include "rayleigh_benard/grid.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace rayleigh_benard;

namespace {

std::vector<double> every(double interval, int rows) {
    std::vector<double> t;
    for (int k = 0; k <= rows; ++k) t.push_back(interval * k);
    return t;
}

/// Of small rolls, late enough for anything else to have died out.
double growth(double rayleigh, int cells) {
    Grid grid({.L = 20.0, .rayleigh = rayleigh, .roll = 1e-3}, cells);
    const GridRun run = run_grid(grid, every(100.0, 4));
    return std::log(run.roll[4] / run.roll[3]) / 100.0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_layer_at_rest_stays_at_rest) {
    Grid grid({.L = 10.0, .rayleigh = 5e3, .roll = 0.0}, 12);
    const auto y = grid.start();
    std::vector<double> y_dot(y.size());
    grid.rates(y, y_dot);
    const std::size_t accounts = y.size() - 2;
    for (std::size_t k = 0; k < accounts; ++k) BOOST_TEST(std::abs(y_dot[k]) < 1e-13);
    const double conducted = grid.layer().conducted();
    BOOST_TEST(std::abs(y_dot[accounts] / conducted - 1.0) < 1e-12);
    BOOST_TEST(std::abs(y_dot[accounts + 1] / conducted + 1.0) < 1e-12);
}

/// What cells give to each other cancels: mass is kept, and horizontal momentum but for the plates' friction.
BOOST_AUTO_TEST_CASE(mass_is_kept) {
    Grid grid({.L = 10.0, .rayleigh = 5e3, .roll = 0.2}, 12);
    const auto y = grid.start();
    std::vector<double> y_dot(y.size());
    grid.rates(y, y_dot);
    const std::size_t n = (y.size() - 2) / 4;
    double mass = 0.0, most = 0.0;
    for (std::size_t k = 0; k < n; ++k) mass += y_dot[k], most = std::max(most, std::abs(y_dot[k]));
    BOOST_TEST(std::abs(mass) < 1e-12 * most * static_cast<double>(n));
    BOOST_TEST(most > 1e-3);
}

BOOST_AUTO_TEST_CASE(cells_converge_with_order_two) {
    const auto heat = [](int cells) {
        Grid grid({.L = 20.0, .rayleigh = 1e4, .roll = 0.05}, cells);
        return run_grid(grid, {0.0, 400.0}).heat_bottom.back() / grid.layer().conducted() / 400.0;
    };
    const double coarse = heat(8), middle = heat(16), fine = heat(32);
    const double order = std::log2((middle - coarse) / (fine - middle));
    BOOST_TEST(order > 1.6);
    BOOST_TEST(order < 2.4);
}

/// 1707.76 is that of a layer whose density and temperature vary little; here they vary by a factor of three.
BOOST_AUTO_TEST_CASE(rolls_begin_to_grow_near_the_critical_rayleigh_number) {
    const double below = growth(1650.0, 16), above = growth(1850.0, 16);
    BOOST_TEST(below < 0.0);
    BOOST_TEST(above > 0.0);
    const double onset = 1650.0 + 200.0 * -below / (above - below);
    BOOST_TEST(std::abs(onset / 1707.76 - 1.0) < 0.03);
}

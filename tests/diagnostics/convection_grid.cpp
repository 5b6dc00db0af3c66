// SPDX-License-Identifier: GPL-3.0-or-later
// Finite differences beside the particles of rayleigh_benard: the layer at rest is exact, cells converge with
// order two, and small rolls begin to grow where linear theory says.
#include "rayleigh_benard/grid.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace rayleigh_benard;

namespace {

/// Between plates of these temperatures at which the gas sticks or slips.
spam::Box<2> between_plates(double L, spam::WallKind kind) {
    spam::Box<2> box({2.0 * L, 0.0});
    box.set_wall(1, false, {kind, 0.0, spam::Point<2>::Zero(), 1.5});
    box.set_wall(1, true, {kind, L, spam::Point<2>::Zero(), 0.5});
    return box;
}
const auto plates10 = between_plates(10.0, spam::WallKind::no_slip),
           plates20 = between_plates(20.0, spam::WallKind::no_slip),
           slippery = between_plates(20.0, spam::WallKind::mirror);

std::vector<double> every(double interval, int rows) {
    std::vector<double> t;
    for (int k = 0; k <= rows; ++k) t.push_back(interval * k);
    return t;
}

/// Of small rolls, late enough for anything else to have died out.
double growth(double rayleigh, const spam::Box<2>& box) {
    Grid grid({.L = 20.0, .rayleigh = rayleigh, .roll = 1e-3}, box, 16);
    const GridRun run = run_grid(grid, every(100.0, 4));
    return std::log(run.roll[4] / run.roll[3]) / 100.0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_layer_at_rest_stays_at_rest) {
    Grid grid({.L = 10.0, .rayleigh = 5e3, .roll = 0.0}, plates10, 12);
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
    Grid grid({.L = 10.0, .rayleigh = 5e3, .roll = 0.2}, plates10, 12);
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
        Grid grid({.L = 20.0, .rayleigh = 1e4, .roll = 0.05}, plates20, cells);
        return run_grid(grid, {0.0, 400.0}).heat_bottom.back() / grid.layer().conducted() / 400.0;
    };
    const double coarse = heat(8), middle = heat(16), fine = heat(32);
    const double order = std::log2((middle - coarse) / (fine - middle));
    BOOST_TEST(order > 1.6);
    BOOST_TEST(order < 2.4);
}

/// 1707.76 is that of a layer whose density and temperature vary little; here they vary by a factor of three.
BOOST_AUTO_TEST_CASE(rolls_begin_to_grow_near_the_critical_rayleigh_number) {
    const auto onset = [](const spam::Box<2>& box, double critical) {
        const double below = growth(0.96 * critical, box), above = growth(1.08 * critical, box);
        BOOST_TEST(below < 0.0);
        BOOST_TEST(above > 0.0);
        return 0.96 + 0.12 * -below / (above - below);
    };
    BOOST_TEST(std::abs(onset(plates20, 1707.76) - 1.0) < 0.03);
    // Of rolls as wide as they are high, which are not those that grow first: 779.27.
    BOOST_TEST(std::abs(onset(slippery, 779.27) - 1.0) < 0.04);
}

/// A box with sides: what leaves through a wall is nothing, and a lid that moves drags.
BOOST_AUTO_TEST_CASE(walls_at_the_sides) {
    spam::Box<2> box;
    box.set_wall(0, false, {spam::WallKind::mirror, 0.0});
    box.set_wall(0, true, {spam::WallKind::no_slip, 20.0});
    box.set_wall(1, false, {spam::WallKind::no_slip, 0.0, spam::Point<2>::Zero(), 1.5});
    box.set_wall(1, true, {spam::WallKind::no_slip, 10.0, {0.2, 0.0}, 0.5});
    Grid grid({.L = 10.0, .rayleigh = 1e3, .roll = 0.0}, box, 10);
    const auto start = grid.start();
    const GridRun run = run_grid(grid, {0.0, 40.0});
    const std::size_t n = (start.size() - 2) / 4;
    double mass = 0.0, momentum = 0.0;
    for (std::size_t k = 0; k < n; ++k) mass += run.y[k], momentum += run.y[n + k];
    BOOST_TEST(std::abs(mass / static_cast<double>(n) - 1.0) < 1e-12);
    const auto u = grid.field(run.y, 1);
    BOOST_TEST(u[static_cast<std::size_t>(9 * grid.nx() + 10)] > 0.05);  // under the lid
    BOOST_TEST(u[static_cast<std::size_t>(2 * grid.nx() + 10)] < 0.0);   // comes back below
}

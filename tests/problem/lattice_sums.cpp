// SPDX-License-Identifier: GPL-3.0-or-later
// How even the density of a lattice is ([HH01] exercise 3): the extremes that the problem `kernels`
// finds and claims, against sums written out over the sites, at every point of a grid over the cell.
#include <boost/test/unit_test.hpp>
#include <kernels/lattices.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace spam;
using std::numbers::pi;

namespace {

double lucy(double r, double h, int dim) {
    const double C = dim == 1 ? 5.0 / (4.0 * h) : 5.0 / (pi * h * h), u = r / h;
    return u < 1.0 ? C * (1.0 + 3.0 * u) * std::pow(1.0 - u, 3) : 0.0;
}

double monaghan(double r, double h, int) {
    const double A = 40.0 / (7.0 * pi * h * h), u = r / h;
    if (u < 0.5) return A * (1.0 - 6.0 * u * u + 6.0 * u * u * u);
    return u < 1.0 ? 2.0 * A * std::pow(1.0 - u, 3) : 0.0;
}

using Weight = double (*)(double r, double h, int dim);

/// Sites at (a + shift b, height b); on the line only those with b = 0. The grid holds sites, middles of
/// edges and cells, and centres of triangles; an extreme between its points is missed by 1e-7.
kernels::Extremes on_a_grid(Weight w, double h, int dim, double shift, double height) {
    constexpr int n = 48, far = 10;
    kernels::Extremes found{1e300, -1e300};
    for (int p = 0; p < n; ++p)
        for (int q = 0; q < (dim == 1 ? 1 : n); ++q) {
            double sum = 0.0;
            for (int a = -far; a <= far; ++a)
                for (int b = dim == 1 ? 0 : -far; b <= (dim == 1 ? 0 : far); ++b) {
                    const double x = double(p) / n - a, y = double(q) / n - b;
                    sum += height * w(std::hypot(x + shift * y, height * y), h, dim);
                }
            found.least = std::min(found.least, sum);
            found.largest = std::max(found.largest, sum);
        }
    return found;
}

void compare(const kernels::Extremes& claimed, const kernels::Extremes& problem,
             const kernels::Extremes& grid) {
    BOOST_TEST(std::abs(claimed.least - grid.least) < 1e-6);
    BOOST_TEST(std::abs(claimed.largest - grid.largest) < 1e-6);
    BOOST_TEST(std::abs(problem.least - grid.least) < 1e-6);
    BOOST_TEST(std::abs(problem.largest - grid.largest) < 1e-6);
}

}  // namespace

BOOST_AUTO_TEST_CASE(extremes_on_a_line) {
    compare({0.997299, 1.003086},
            density_extremes(kernels::line(), weight_function<1>("lucy", 3.0)),
            on_a_grid(lucy, 3.0, 1, 0.0, 1.0));
}

BOOST_AUTO_TEST_CASE(extremes_in_the_square_lattice) {
    const auto at = [](const char* law, double h) {
        return density_extremes(kernels::square(), weight_function<2>(law, h));
    };
    compare({0.989534, 1.023762}, at("lucy", 1.5), on_a_grid(lucy, 1.5, 2, 0.0, 1.0));
    compare({0.998033, 1.002930}, at("lucy", 3.0), on_a_grid(lucy, 3.0, 2, 0.0, 1.0));
    compare({0.999914, 1.000090}, at("lucy", 6.0), on_a_grid(lucy, 6.0, 2, 0.0, 1.0));
    compare({0.996192, 1.003440}, at("monaghan", 3.0), on_a_grid(monaghan, 3.0, 2, 0.0, 1.0));
}

BOOST_AUTO_TEST_CASE(extremes_in_the_triangular_lattice) {
    const double height = std::sqrt(0.75);
    compare({0.999933, 1.000334},
            density_extremes(kernels::triangular(), weight_function<2>("lucy", 3.0)),
            on_a_grid(lucy, 3.0, 2, 0.5, height));
    // Another range is told apart.
    const auto other = on_a_grid(lucy, 3.1, 2, 0.5, height);
    BOOST_TEST(std::abs(other.largest - 1.000334) > 1e-5);
}

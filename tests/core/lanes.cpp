// SPDX-License-Identifier: GPL-3.0-or-later
// Lanes compute what plain numbers compute; square roots and quotients to a unit in the last place.
// This file is compiled for every instruction set, like the sweeps.
#include <spam/core/instruction_set.hpp>
#include <spam/core/lanes.hpp>

#include <boost/test/unit_test.hpp>

#include <limits>
#include <random>

using namespace spam;

namespace {

/// Throws, before anything else, where the processor cannot do what this file is compiled for.
struct Settled {
    Settled() { instruction_set(); }
};
BOOST_GLOBAL_FIXTURE(Settled);

template <int W, class F, class G>
double worst_difference(const F& lanes, const G& plain, double least, double most) {
    std::mt19937_64 random(81);
    std::uniform_real_distribution<double> exponent(std::log10(least), std::log10(most));
    double worst = 0.0;
    for (int k = 0; k < 100000; ++k) {
        LanesOf<W> a(0.0), b(0.0);
        for (int l = 0; l < W; ++l) {
            set_lane(a, l, std::pow(10.0, exponent(random)));
            set_lane(b, l, std::pow(10.0, exponent(random)));
        }
        const LanesOf<W> r = lanes(a, b);
        for (int l = 0; l < W; ++l) {
            const double expected = plain(lane(a, l), lane(b, l));
            worst = std::max(worst, std::abs(lane(r, l) - expected) / std::abs(expected));
        }
    }
    return worst;
}

template <int W>
void check() {
    using T = LanesOf<W>;
    const double unit = std::numeric_limits<double>::epsilon();
    const auto root = [](const auto& a, const auto&) {
        using std::sqrt;
        return sqrt(a);
    };
    const auto quotient = [](const auto& a, const auto& b) { return a / b; };
    BOOST_TEST((worst_difference<W>(root, root, 1e-250, 1e300)) <= unit);
    const auto products = [](const auto& x, const auto&) { return sqrt_by_products(x); };
    BOOST_TEST((worst_difference<W>(products, root, 1e-250, 1e300)) <= 2.0 * unit);
    const auto inverse = [](const auto& x, const auto&) { return inverse_sqrt_by_products(x); };
    BOOST_TEST((worst_difference<W>(
                   inverse, [](double x, double) { return 1.0 / std::sqrt(x); }, 1e-250, 1e300)) <=
               2.0 * unit);
    BOOST_TEST((worst_difference<W>(quotient, quotient, 1e-100, 1e100)) <= unit);

    using std::sqrt, std::max;
    const T nan(std::numeric_limits<double>::quiet_NaN());
    BOOST_TEST(lane(T(0.0) / T(3.0), 0) == 0.0);
    BOOST_TEST(lane(positive_part(T(-2.0)), 0) == 0.0);
    BOOST_TEST(lane(positive_part(T(2.0)), W - 1) == 2.0);
    BOOST_TEST(std::isnan(lane(positive_part(nan), 0)));
    BOOST_TEST(lane(max(T(1.0), T(2.0)), 0) == 2.0);
    for (const double x : {-1.5, -0.7, -0.5, 0.0, 0.5, 0.7, 1.5})
        BOOST_TEST(lane(nearest_integer(T(x)), W - 1) == std::nearbyint(x));
    T a(1.0), b(2.0);
    set_lane(a, W - 1, 3.0);
    BOOST_TEST(lanes_below(a, b) == (1U << (W - 1)) - 1);
    BOOST_TEST(lane(where_below(a, b, T(5.0)), W - 1) == 0.0);
    BOOST_TEST(lane(where_below(b, a, T(5.0)), W - 1) == 5.0);
    BOOST_TEST(lane(where_below(a, b, T(5.0)), 0) == (W == 1 ? 0.0 : 5.0));
    BOOST_TEST(lane(where_below(b, b, T(5.0)), 0) == 0.0);
    a += b * a - T(1.0);
    BOOST_TEST(lane(a, W - 1) == 8.0);
    BOOST_TEST(lane(-a, W - 1) == -8.0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(one) { check<1>(); }
BOOST_AUTO_TEST_CASE(two) { check<2>(); }
BOOST_AUTO_TEST_CASE(four) { check<4>(); }
BOOST_AUTO_TEST_CASE(eight) { check<8>(); }

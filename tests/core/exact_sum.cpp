// SPDX-License-Identifier: GPL-3.0-or-later
// ExactSum against arithmetic with as many bits as all doubles have, in any order and however parted.
#include <spam/core/exact_sum.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using spam::ExactSum;

namespace {

using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<2300, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

double wide_sum(const std::vector<double>& x) {
    Wide sum = 0;
    for (const double term : x) sum += Wide(term);
    return sum.convert_to<double>();
}

double one_by_one(const std::vector<double>& x) {
    ExactSum sum;
    for (const double term : x) sum += term;
    return sum;
}
double by_blocks(const std::vector<double>& x) {
    return spam::exact_sum(x.size(), [&](std::size_t i) { return x[i]; });
}
double by_parts(const std::vector<double>& x, std::size_t size) {
    ExactSum sum;
    for (std::size_t first = 0; first < x.size(); first += size) {
        ExactSum part;
        for (std::size_t i = first; i < std::min(first + size, x.size()); ++i) part += x[i];
        sum += part;
    }
    return sum;
}

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// All ways to take the sum give these bits.
void check_sum(std::vector<double> x, double wanted, std::mt19937& random) {
    for (int order = 0; order < 3; ++order) {
        BOOST_TEST(same_bits(one_by_one(x), wanted));
        BOOST_TEST(same_bits(by_blocks(x), wanted));
        BOOST_TEST(same_bits(by_parts(x, 1 + random() % 300), wanted));
        std::shuffle(x.begin(), x.end(), random);
    }
}

/// Numbers between 2^-range and 2^range.
std::vector<double> numbers(std::size_t n, double range, std::mt19937& random) {
    std::uniform_real_distribution<double> exponent(-range, range), mantissa(-1.0, 1.0);
    std::vector<double> x(n);
    for (double& term : x) term = mantissa(random) * std::exp2(exponent(random));
    return x;
}

}  // namespace

BOOST_AUTO_TEST_CASE(sums_are_the_nearest_doubles) {
    std::mt19937 random(1);
    for (const double range : {0.0, 3.0, 20.0, 60.0, 300.0, 990.0})
        for (const std::size_t n : {1U, 2U, 7U, 255U, 256U, 257U, 5000U}) {
            const auto x = numbers(n, range, random);
            BOOST_TEST_CONTEXT("range " << range << ", n " << n)
            check_sum(x, wide_sum(x), random);
        }
}

BOOST_AUTO_TEST_CASE(what_cancels_leaves_the_last_bits) {
    std::mt19937 random(2);
    for (const double range : {0.0, 20.0, 500.0}) {
        auto x = numbers(1500, range, random);
        for (std::size_t i = 0; i < 1500; ++i) x.push_back(-x[i]);
        check_sum(x, 0.0, random);
        x.push_back(0x1p-1070);
        check_sum(x, 0x1p-1070, random);
        x.push_back(-3.0);
        check_sum(x, -3.0, random);
    }
}

BOOST_AUTO_TEST_CASE(halves_are_rounded_to_even_and_what_is_below_them_counts) {
    std::mt19937 random(3);
    const double half = 0x1p-53;
    check_sum({1.0, half}, 1.0, random);
    check_sum({1.0, half, 0x1p-1074}, 1.0 + 0x1p-52, random);
    check_sum({1.0, half, -0x1p-1074}, 1.0, random);
    check_sum({1.0 + 0x1p-52, half}, 1.0 + 0x1p-51, random);
    check_sum({-1.0, -half, -0x1p-1074}, -1.0 - 0x1p-52, random);
}

BOOST_AUTO_TEST_CASE(the_ends_of_the_range) {
    std::mt19937 random(4);
    const double most = std::numeric_limits<double>::max(),
                 least = std::numeric_limits<double>::denorm_min(),
                 infinity = std::numeric_limits<double>::infinity();
    check_sum({}, 0.0, random);
    check_sum({most, -most, least}, least, random);
    check_sum({most, most, -most}, most, random);  // what is too much on the way is not lost
    check_sum({most, most}, infinity, random);
    check_sum({-most, -most, 1.0}, -infinity, random);
    check_sum(std::vector<double>(1000, least), 1000.0 * least, random);
    check_sum({1.0, infinity, most}, infinity, random);
    check_sum({1.0, -infinity, 2.0}, -infinity, random);
    for (const auto& x :
         {std::vector<double>{1.0, std::nan(""), 2.0}, {infinity, -infinity, 1.0}}) {
        BOOST_TEST(std::isnan(one_by_one(x)));
        BOOST_TEST(std::isnan(by_blocks(x)));
        BOOST_TEST(std::isnan(by_parts(x, 1)));
    }
}

BOOST_AUTO_TEST_CASE(scaled_by_a_power_of_two_the_bits_stay) {
    std::mt19937 random(5);
    const auto x = numbers(3000, 15.0, random);
    const double sum = by_blocks(x);
    for (int power = -45; power < 45; ++power) {
        auto scaled = x;
        for (double& term : scaled) term = std::ldexp(term, power);
        BOOST_TEST(same_bits(by_blocks(scaled), std::ldexp(sum, power)));
    }
}

/// More terms than a digit holds without carrying.
BOOST_AUTO_TEST_CASE(very_many_terms) {
    ExactSum sum;
    const double term = 0x1.fffffffffffffp+0;
    const std::size_t n = 9'000'000;
    for (std::size_t i = 0; i < n; ++i) sum += term;
    const double wanted = (Wide(term) * n).convert_to<double>();
    BOOST_TEST(same_bits(sum, wanted));
    BOOST_TEST(same_bits(spam::exact_sum(n, [=](std::size_t) { return term; }), wanted));
}

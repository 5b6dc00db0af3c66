// SPDX-License-Identifier: GPL-3.0-or-later
// Orders and growths fitted to errors and drifts whose law is known.
#include <spam/diagnostics/convergence.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

using namespace spam;

namespace {

constexpr double floor_of_errors = 1e-13;
using Law = std::function<double(double)>;

/// Errors of that law at steps 1, 2^-1/2, ..., with round-off at the floor.
ConvergenceFit fit(const Law& law, const ConvergenceRule& rule) {
    std::vector<double> step, error;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> u(0.3, 1.0);
    for (int k = 0; k < 24; ++k) {
        step.push_back(std::pow(2.0, -0.5 * k));
        error.push_back(law(step.back()) + floor_of_errors * u(random));
    }
    return fit_convergence(step, error, floor_of_errors, rule);
}

/// C h^p with higher orders on top, as methods have them; wild where steps are too large.
Law method(int order) {
    return [order](double h) {
        const double z = 0.6 * h;
        return 3e-3 * std::pow(z, order) * (1.0 + 0.5 * z + z * z) + (h > 0.9 ? 1e3 : 0.0);
    };
}

/// Which orders the fit gets wrong by more than the tenth that is claimed.
std::vector<int> wrong_orders(const std::function<Law(int)>& law) {
    std::vector<int> wrong;
    for (int order = 2; order <= 6; ++order) {
        const auto found = fit(law(order), ConvergenceRule::smooth());
        if (!found.known() || std::abs(found.order - order) > 0.1) wrong.push_back(order);
    }
    return wrong;
}

GrowthFit growth(const Law& law) {
    std::vector<double> t, change;
    for (int k = 0; k <= 600; ++k) {
        t.push_back(k);
        change.push_back(law(t.back()));
    }
    return fit_growth(t, change, 1e-13);
}

/// The change of an energy that is right in the mean, and what is done to it.
std::vector<double> walk(double step) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    std::vector<double> place{0.0};
    for (int k = 0; k < 600; ++k) place.push_back(place.back() + step * normal(random));
    return place;
}

}  // namespace

BOOST_AUTO_TEST_CASE(orders_between_the_asymptote_and_round_off_are_found) {
    BOOST_TEST(wrong_orders(method).empty());
}

/// Mutated: an error term half an order lower spoils every one of them.
BOOST_AUTO_TEST_CASE(a_lost_half_order_is_seen) {
    const auto spoiled = [](int order) {
        return
            [order](double h) { return method(order)(h) + 1e-3 * std::pow(0.6 * h, order - 0.5); };
    };
    BOOST_TEST(wrong_orders(spoiled).size() == 5u);
}

/// Order 8 until a kink of order 3 takes over: the smallest steps decide.
BOOST_AUTO_TEST_CASE(the_smallest_steps_decide) {
    const auto found =
        fit([](double h) { return method(8)(h) + 1e-6 * h * h * h; }, ConvergenceRule::smooth());
    BOOST_REQUIRE(found.known());
    BOOST_TEST(found.order == 3.0, boost::test_tools::tolerance(0.02));
    BOOST_TEST(found.largest_step < 0.3);
}

BOOST_AUTO_TEST_CASE(scattered_slopes_have_an_average_order) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> factor(0.75, 1.3);
    const auto jumps = [&](double h) { return 1e-4 * h * factor(random); };
    const auto found = fit(jumps, ConvergenceRule::rough());
    BOOST_TEST(found.points > 15u);
    BOOST_TEST(found.order == 1.0, boost::test_tools::tolerance(0.05));
    BOOST_TEST(found.order_error > 0.001);
}

BOOST_AUTO_TEST_CASE(what_tells_nothing_gives_no_order) {
    const auto smooth = ConvergenceRule::smooth();
    BOOST_TEST(!fit([](double) { return 0.0; }, smooth).known());           // round-off alone
    BOOST_TEST(!fit([](double) { return std::nan(""); }, smooth).known());  // all unstable
    BOOST_TEST(!fit([](double h) { return h > 0.5 ? 1e-4 * h : 0.0; }, smooth).known());  // too few
    BOOST_TEST(!fit_convergence({}, {}, 0.0, smooth).known());
}

BOOST_AUTO_TEST_CASE(a_steady_drift_is_secular) {
    const auto fit = growth([](double t) { return 1e-9 * t + 1e-9 * std::sin(t); });
    BOOST_TEST(fit.exponent == 1.0, boost::test_tools::tolerance(0.03));
    BOOST_TEST(fit.kind() == "secular");
    BOOST_TEST(growth([](double t) { return 1e-9 * t * t; }).exponent == 2.0,
               boost::test_tools::tolerance(0.01));
}

BOOST_AUTO_TEST_CASE(an_oscillation_is_bounded) {
    const auto fit = growth([](double t) { return 1e-5 * std::sin(0.7 * t); });
    BOOST_TEST(std::abs(fit.exponent) < 0.02);
    BOOST_TEST(fit.kind() == "bounded");
}

/// Mutated: the same with a leak too small to see in the first tenth.
BOOST_AUTO_TEST_CASE(a_leaking_oscillation_is_not_bounded) {
    const auto fit = growth([](double t) { return 1e-5 * std::sin(0.7 * t) + 1e-6 * t; });
    BOOST_TEST(fit.exponent > 0.75);
    BOOST_TEST(fit.kind() != "bounded");
}

BOOST_AUTO_TEST_CASE(random_steps_walk) {
    const auto place = walk(1e-10);
    const auto fit = growth([&](double t) { return place[static_cast<std::size_t>(t)]; });
    BOOST_TEST(fit.kind() == "random walk", "exponent " << fit.exponent);
    const auto fine = walk(1e-16);
    BOOST_TEST(growth([&](double t) { return fine[static_cast<std::size_t>(t)]; }).kind() ==
               "round-off");
    BOOST_TEST(growth([](double) { return 0.0; }).kind() == "round-off");
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_is_not_hidden) {
    const auto fit = growth([](double t) { return t > 300.0 ? std::nan("") : 1e-9 * t; });
    BOOST_TEST(!(fit.largest < 1.0));
}

BOOST_AUTO_TEST_CASE(what_is_no_number_does_not_grow) {
    const std::vector<double> t{1, 2, 3, 4}, change{5.0, 5.0, std::nan(""), 0.1};
    BOOST_TEST(std::isnan(fit_growth(t, change, 1e-13).largest));
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/kernel/lucy.hpp>

#include <boost/test/unit_test.hpp>
#include <gsl/gsl_deriv.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <functional>

using namespace spam;

namespace {

double call(double x, void* f) { return (*static_cast<std::function<double(double)>*>(f))(x); }

double integral(std::function<double(double)> f, double a, double b) {
    gsl_function g{&call, &f};
    double result = 0.0, error = 0.0;
    std::size_t evaluations = 0;
    gsl_integration_qng(&g, a, b, 1e-13, 1e-13, &result, &error, &evaluations);
    return result;
}

double derivative(std::function<double(double)> f, double x) {
    gsl_function g{&call, &f};
    double result = 0.0, error = 0.0;
    gsl_deriv_central(&g, x, 1e-4, &result, &error);
    return result;
}

/// Integral of w over the line, plane or space.
template <int Dim, class Weight>
double norm(const Weight& w) {
    const double surface = Dim == 1   ? 2.0
                           : Dim == 2 ? 2.0 * std::numbers::pi
                                      : 4.0 * std::numbers::pi;
    return integral([&](double r) { return surface * std::pow(r, Dim - 1) * w.value(r); }, 0.0,
                    w.range());
}

template <class Weight>
double slope_error(const Weight& w) {
    double worst = 0.0;
    for (double r = 0.05; r < w.range() - 0.01; r += 0.1) {
        const double numeric = derivative([&](double x) { return w.value(x); }, r);
        worst = std::max(worst, std::abs(numeric + r * w.minus_slope_over_r(r)));
    }
    return worst;
}

/// Lucy's weight function as it would be with the misprint 5/(9 pi h^2), and a wrong slope.
struct Misprinted {
    Lucy<2> lucy{3.0};
    double range() const { return 3.0; }
    double value(double r) const { return lucy.value(r) / 9.0; }
    double minus_slope_over_r(double r) const { return lucy.minus_slope_over_r(r); }
};

template <int Dim>
void check() {
    for (const double h : {0.5, 1.5, 3.0, 6.0}) {
        const Lucy<Dim> w(h);
        BOOST_TEST(std::abs(norm<Dim>(w) - 1.0) < 1e-12);
        BOOST_TEST(slope_error(w) < 1e-8 * w.value(0.0) / h);
        BOOST_TEST(w.range() == h);
        for (const double r : {h, 1.0001 * h, 2.0 * h, 100.0 * h}) {
            BOOST_TEST(w.value(r) == 0.0);
            BOOST_TEST(w.minus_slope_over_r(r) == 0.0);
        }
        BOOST_TEST(std::isfinite(w.minus_slope_over_r(0.0)));
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(normalised_with_its_own_slope_1d) { check<1>(); }
BOOST_AUTO_TEST_CASE(normalised_with_its_own_slope_2d) { check<2>(); }
BOOST_AUTO_TEST_CASE(normalised_with_its_own_slope_3d) { check<3>(); }

BOOST_AUTO_TEST_CASE(the_misprinted_prefactor_fails) {
    BOOST_TEST(std::abs(norm<2>(Misprinted{}) - 1.0) > 0.5);
    BOOST_TEST(slope_error(Misprinted{}) > 1e-2);
}

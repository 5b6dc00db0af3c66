// SPDX-License-Identifier: GPL-3.0-or-later
// Every weight function is normalised, zero from its range on, and has the derivatives it says it
// has, in numbers and in lanes; and where a constant, a slope or the claimed smoothness is wrong,
// that is noticed.
#include <spam/core/error.hpp>
#include <spam/core/lanes.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/kernel/monaghan_cubic.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/kernel/wn.hpp>

#include <boost/test/unit_test.hpp>
#include <gsl/gsl_deriv.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <functional>

using namespace spam;
using std::numbers::pi;

namespace {

double call(double x, void* f) { return (*static_cast<std::function<double(double)>*>(f))(x); }

double integral(std::function<double(double)> f, double a, double b) {
    gsl_function g{&call, &f};
    double result = 0.0, error = 0.0;
    std::size_t evaluations = 0;
    gsl_integration_qng(&g, a, b, 1e-13, 1e-13, &result, &error, &evaluations);
    return result;
}

double derivative(std::function<double(double)> f, double x, double step) {
    gsl_function g{&call, &f};
    double result = 0.0, error = 0.0;
    gsl_deriv_central(&g, x, step, &result, &error);
    return result;
}

/// Integral of w over the line, plane or space, the halves apart: a spline has a joint there.
template <int Dim, class Weight>
double norm(const Weight& w) {
    const double surface = Dim == 1 ? 2.0 : Dim == 2 ? 2.0 * pi : 4.0 * pi, h = w.range();
    const auto shell = [&](double r) { return surface * std::pow(r, Dim - 1) * w.value(r); };
    return integral(shell, 0.0, 0.5 * h) + integral(shell, 0.5 * h, h);
}

/// The worst error of w', w'' and w''' against numerical derivatives of w, w' and w'', in units of
/// K h, K and K/h with K the law's largest -w'/r, away from joints.
template <class Weight>
std::array<double, 3> derivative_errors(const Weight& w) {
    std::array<double, 3> worst{};
    const double h = w.range(), K = w.minus_slope_over_r(0.0), step = 1e-3 * h;
    for (double u = 0.0213; u < 0.99; u += 0.0313) {
        if (std::abs(u - 0.5) < 0.01) continue;
        const double r = u * h;
        const auto slope = [&](double x) { return -x * w.minus_slope_over_r(x); };
        const double d1 = derivative([&](double x) { return w.value(x); }, r, step);
        const double d2 = derivative(slope, r, step);
        const double d3 = derivative([&](double x) { return w.second_derivative(x); }, r, step);
        worst[0] = std::max(worst[0], std::abs(d1 - slope(r)) / (K * h));
        worst[1] = std::max(worst[1], std::abs(d2 - w.second_derivative(r)) / K);
        worst[2] = std::max(worst[2], std::abs(d3 - w.third_derivative(r)) / K * h);
    }
    return worst;
}

/// How many derivatives are continuous where pieces meet: at the range and at half of it.
template <class Weight>
int smoothness(const Weight& w) {
    const double h = w.range(), d = 1e-9 * h, unit = w.value(0.0);
    for (const double joint : {0.5 * h, h}) {
        const double below = joint - d, above = joint + d;
        const auto slope = [&](double r) { return r * w.minus_slope_over_r(r); };
        if (std::abs(slope(above) - slope(below)) > 1e-6 * unit / h) return 0;
        if (std::abs(w.second_derivative(above) - w.second_derivative(below)) >
            1e-6 * unit / (h * h))
            return 1;
    }
    for (const double joint : {0.5 * h, h})
        if (std::abs(w.third_derivative(joint + d) - w.third_derivative(joint - d)) >
            1e-6 * unit / (h * h * h))
            return 2;
    return 3;  // or more
}

/// Lanes do what numbers do, inside, at the joints, at the range and beyond.
template <class Weight>
void check_lanes(const Weight& w) {
    const double h = w.range();
    for (const double u : {0.0, 0.1, 0.3, 0.49, 0.5, 0.7, 0.99, 1.0, 1.1}) {
        Lanes<4> r(u * h);
        set_lane(r, 1, 0.5 * u * h);
        const auto value = w.value(r), slope = w.minus_slope_over_r(r);
        for (int l = 0; l < 4; ++l) {
            const double x = lane(r, l);
            BOOST_TEST(std::abs(lane(value, l) - w.value(x)) <= 4e-16 * w.value(0.0));
            BOOST_TEST(std::abs(lane(slope, l) - w.minus_slope_over_r(x)) <=
                       4e-16 * w.minus_slope_over_r(0.0));
        }
    }
}

template <template <int> class Weight, int Dim>
void check() {
    for (const double h : {0.5, 1.5, 2.7, 3.0, 3.3, 6.0}) {
        const Weight<Dim> w(h);
        BOOST_TEST(std::abs(norm<Dim>(w) - 1.0) < 1e-12);
        const auto errors = derivative_errors(w);
        for (const double error : errors) BOOST_TEST(error < 1e-8);
        BOOST_TEST(w.range() == h);
        for (const double r : {h, 1.0001 * h, 2.0 * h, 100.0 * h}) {
            BOOST_TEST(w.value(r) == 0.0);
            BOOST_TEST(w.minus_slope_over_r(r) == 0.0);
            BOOST_TEST(w.second_derivative(r) == 0.0);
            BOOST_TEST(w.third_derivative(r) == 0.0);
        }
        BOOST_TEST(smoothness(w) == std::min(3, Weight<Dim>::continuous_derivatives));
        // At the origin w' = w'' r: the Laplacian is Dim times either.
        const double middle = -Dim * w.minus_slope_over_r(0.0);
        BOOST_TEST(std::abs(laplacian<Dim>(w, 0.0) - middle) < 1e-14 * std::abs(middle));
        check_lanes(w);
    }
}

template <template <int> class Weight>
void check_in_every_dimension() {
    check<Weight, 1>();
    check<Weight, 2>();
    check<Weight, 3>();
}

template <int Dim>
using W2 = Wn<Dim, 2>;
template <int Dim>
using W3 = Wn<Dim, 3>;
template <int Dim>
using W4 = Wn<Dim, 4>;
template <int Dim>
using W5 = Wn<Dim, 5>;
template <int Dim>
using W8 = Wn<Dim, 8>;

/// A law with one thing wrong.
template <class Weight>
struct Mutated {
    static constexpr int continuous_derivatives = Weight::continuous_derivatives;
    Weight law{3.0};
    double prefactor = 1.0, slope = 1.0, second = 1.0;
    double range() const { return law.range(); }
    double value(double r) const { return prefactor * law.value(r); }
    double minus_slope_over_r(double r) const { return slope * law.minus_slope_over_r(r); }
    double second_derivative(double r) const { return second * law.second_derivative(r); }
    double third_derivative(double r) const { return law.third_derivative(r); }
};

template <class Weight>
void check_mutations() {
    using M = Mutated<Weight>;
    BOOST_TEST(std::abs(norm<2>(M{.prefactor = 1.001}) - 1.0) > 1e-4);
    BOOST_TEST(derivative_errors(M{.slope = 1.001})[0] > 1e-5);
    BOOST_TEST(derivative_errors(M{.second = 1.001})[1] > 1e-5);
    BOOST_TEST(derivative_errors(M{.second = 1.001})[2] > 1e-5);
}

/// A spline that forgets its inner piece: two thirds of it look right, but its slope jumps at h/2.
struct OuterPieceOnly {
    MonaghanCubic<2> law{3.0};
    double range() const { return 3.0; }
    double value(double r) const { return r < 1.5 ? law.value(1.5) : law.value(r); }
    double minus_slope_over_r(double r) const { return r < 1.5 ? 0.0 : law.minus_slope_over_r(r); }
    double second_derivative(double r) const { return r < 1.5 ? 0.0 : law.second_derivative(r); }
    double third_derivative(double r) const { return r < 1.5 ? 0.0 : law.third_derivative(r); }
};

}  // namespace

BOOST_AUTO_TEST_CASE(lucy) { check_in_every_dimension<Lucy>(); }
BOOST_AUTO_TEST_CASE(monaghan) { check_in_every_dimension<MonaghanCubic>(); }
BOOST_AUTO_TEST_CASE(the_family_w_n) {
    check_in_every_dimension<W2>();
    check_in_every_dimension<W3>();
    check_in_every_dimension<W4>();
    check_in_every_dimension<W5>();
    check_in_every_dimension<W8>();
}

namespace {

/// The one formula for all of them against the law's own, in numbers and in lanes.
template <int Dim>
void check_general(Kernel kernel, double h) {
    const GeneralWeight<Dim> general(kernel, h);
    const AnyWeight<Dim> own = weight_function<Dim>(to_string(kernel), h);
    BOOST_TEST(general.range() == h);
    BOOST_TEST(general.continuous_derivatives == own.continuous_derivatives);
    check_lanes(general);
    const double unit = own.value(0.0), K = own.minus_slope_over_r(0.0);
    for (double u = 0.0; u < 1.2; u += 0.0171) {
        const double r = u * h;
        BOOST_TEST(std::abs(general.value(r) - own.value(r)) < 4e-15 * unit);
        BOOST_TEST(std::abs(general.minus_slope_over_r(r) - own.minus_slope_over_r(r)) < 4e-15 * K);
        const double second = general.second_derivative(r) - own.second_derivative(r);
        if (own.continuous_derivatives >= 2) BOOST_TEST(std::abs(second) < 2e-14 * K);
        const double third = general.third_derivative(r) - own.third_derivative(r);
        if (own.continuous_derivatives >= 3) BOOST_TEST(std::abs(third) < 2e-13 * K / h);
        if (u < 1.0) continue;
        BOOST_TEST(general.value(r) == 0.0);
        BOOST_TEST(general.minus_slope_over_r(r) == 0.0);
    }
    BOOST_TEST(general.value(h) == 0.0);
    BOOST_TEST(general.minus_slope_over_r(h) == 0.0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(one_formula_for_all_of_them) {
    for (const Kernel kernel : all_kernels())
        for (const double h : {0.5, 2.7, 3.0, 6.0}) {
            BOOST_TEST_CONTEXT(to_string(kernel) << ", h = " << h) {
                check_general<1>(kernel, h);
                check_general<2>(kernel, h);
                check_general<3>(kernel, h);
            }
        }
    // Another member of the family is not taken for the one asked for.
    const GeneralWeight<2> w5(Kernel::w5, 3.0);
    BOOST_TEST(std::abs(w5.value(1.0) - W4<2>(3.0).value(1.0)) > 1e-3);
    BOOST_CHECK_THROW(GeneralWeight<2>(Kernel::w5, 0.0), InputError);
}

BOOST_AUTO_TEST_CASE(integrals_over_weight_functions) {
    BOOST_TEST(std::abs(moment<2>(Lucy<2>(3.0), 2) - 5.0 * 9.0 / 28.0) < 1e-13);
    BOOST_TEST(std::abs(moment<3>(MonaghanCubic<3>(1.5), 0) - 1.0) < 1e-13);
    const auto second_moment = [](double r) { return 2.0 * r * r * Wn<1, 5>(2.0).value(r); };
    BOOST_TEST(std::abs(moment<1>(Wn<1, 5>(2.0), 2) - integral(second_moment, 0.0, 2.0)) < 1e-6);
    // The gradient sum of sin kx, by summing over a fine square lattice.
    const MonaghanCubic<2> w(2.0);
    double largest = 0.0;
    for (double k = 0.125; k < 4.0; k += 0.125) {
        double sum = 0.0;
        for (double x = -2.0; x <= 2.0; x += 0.04)
            for (double y = -2.0; y <= 2.0; y += 0.04)
                sum += 0.0016 * w.minus_slope_over_r(std::hypot(x, y)) * x * std::sin(k * x);
        largest = std::max(largest, sum);
    }
    BOOST_TEST(std::abs(steepest_wave<2>(w) - largest) < 1e-3 * largest);
    // Sound of the steeper weight is faster, and its step shorter, never longer, whatever the range.
    const double steeper = steepest_wave<2>(Wn<2, 8>(1.0)) / steepest_wave<2>(Lucy<2>(1.0));
    BOOST_TEST(steeper > 1.6);
    BOOST_TEST(std::abs(relative_step<2>(Wn<2, 8>(3.0), Lucy<2>(3.0)) * steeper - 1.0) < 1e-12);
    BOOST_TEST((relative_step<2>(Wn<2, 2>(3.0), Lucy<2>(3.0))) == 1.0);
    BOOST_TEST(relative_step<2>(Lucy<2>(3.0), Lucy<2>(3.0)) == 1.0);
}

BOOST_AUTO_TEST_CASE(constants_as_they_are_written) {
    const double h = 3.0;
    BOOST_TEST(std::abs(Lucy<2>(h).value(0.0) - 5.0 / (pi * h * h)) < 1e-15);  // not 5/(9 pi h^2)
    BOOST_TEST(std::abs(MonaghanCubic<2>(h).value(0.0) - 40.0 / (7.0 * pi * h * h)) < 1e-15);
    BOOST_TEST(std::abs(MonaghanCubic<3>(h).value(0.0) - 8.0 / (pi * h * h * h)) < 1e-15);
    BOOST_TEST(std::abs(W5<1>(h).value(0.0) - 7.0 / (4.0 * h)) < 1e-15);
    BOOST_TEST(std::abs(W5<2>(h).value(0.0) - 56.0 / (6.0 * pi * h * h)) < 1e-15);
    BOOST_TEST(std::abs(W5<3>(h).value(0.0) - 504.0 / (32.0 * pi * h * h * h)) < 1e-15);
}

BOOST_AUTO_TEST_CASE(w_3_is_lucy) {
    for (const double r : {0.0, 0.4, 1.0, 2.9}) {
        BOOST_TEST(std::abs(W3<2>(3.0).value(r) - Lucy<2>(3.0).value(r)) < 1e-16);
        BOOST_TEST(std::abs(W3<2>(3.0).third_derivative(r) - Lucy<2>(3.0).third_derivative(r)) <
                   1e-16);
    }
}

BOOST_AUTO_TEST_CASE(the_pieces_of_the_spline_as_printed) {
    const MonaghanCubic<1> w(2.0);  // A = 2/3
    for (const double u : {0.1, 0.3, 0.5}) {
        const double inner = 1.0 - 6.0 * u * u + 6.0 * u * u * u;
        BOOST_TEST(std::abs(w.value(2.0 * u) - 2.0 / 3.0 * inner) < 1e-15);
    }
    for (const double u : {0.5, 0.7, 0.9})
        BOOST_TEST(std::abs(w.value(2.0 * u) - 4.0 / 3.0 * std::pow(1.0 - u, 3)) < 1e-15);
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_noticed) {
    check_mutations<Lucy<2>>();
    check_mutations<MonaghanCubic<2>>();
    check_mutations<W5<2>>();
    BOOST_TEST(smoothness(OuterPieceOnly{}) == 0);
}

BOOST_AUTO_TEST_CASE(any_weight_by_name) {
    const auto same = [](const AnyWeight<2>& a, const auto& b) {
        double worst = std::abs(a.range() - b.range());
        for (double r = 0.0; r < 3.5; r += 0.25)
            worst = std::max({worst, std::abs(a.value(r) - b.value(r)),
                              std::abs(a.minus_slope_over_r(r) - b.minus_slope_over_r(r)),
                              std::abs(a.second_derivative(r) - b.second_derivative(r)),
                              std::abs(a.third_derivative(r) - b.third_derivative(r))});
        return worst == 0.0 && a.continuous_derivatives == b.continuous_derivatives;
    };
    BOOST_TEST(same(weight_function<2>("lucy", 3.0), Lucy<2>(3.0)));
    BOOST_TEST(same(weight_function<2>("monaghan", 3.0), MonaghanCubic<2>(3.0)));
    BOOST_TEST(same(weight_function<2>("w2", 3.0), Wn<2, 2>(3.0)));
    BOOST_TEST(same(weight_function<2>("w5", 3.0), Wn<2, 5>(3.0)));
    BOOST_TEST(same(weight_function<2>("w8", 3.0), Wn<2, 8>(3.0)));
    BOOST_TEST(!same(weight_function<2>("w5", 3.0), Wn<2, 4>(3.0)));
    for (const char* name : {"gauss", "w1", "w9", "w", "w12", "Lucy", ""})
        BOOST_CHECK_THROW(weight_function<2>(name, 3.0), InputError);
    for (const double range : {0.0, -1.0, std::nan(""), double(INFINITY)})
        BOOST_CHECK_THROW(weight_function<2>("lucy", range), InputError);
}

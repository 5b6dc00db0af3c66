// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/kernel/weight_integrals.hpp>

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <numbers>

namespace spam {
namespace {

using GaussRule =
    std::unique_ptr<gsl_integration_glfixed_table, decltype(&gsl_integration_glfixed_table_free)>;

GaussRule gauss_rule(std::size_t points) {
    GaussRule rule(gsl_integration_glfixed_table_alloc(points),
                   &gsl_integration_glfixed_table_free);
    if (!rule) throw std::bad_alloc();
    return rule;
}

/// Integral of f(r) over the line, plane or space within the range, by Gauss' rule in each half of the range: weight
/// functions are polynomials there (the cubic spline has a joint in the middle), for which it is exact.
template <int Dim, class F>
double over_space(double range, const F& f) {
    constexpr std::size_t points = 32;
    const GaussRule table = gauss_rule(points);
    const double surface = Dim == 1   ? 2.0
                           : Dim == 2 ? 2.0 * std::numbers::pi
                                      : 4.0 * std::numbers::pi;
    double sum = 0.0;
    for (const double from : {0.0, 0.5 * range})
        for (std::size_t k = 0; k < points; ++k) {
            double r = 0.0, area = 0.0;
            gsl_integration_glfixed_point(from, from + 0.5 * range, k, &r, &area, table.get());
            area *= surface;
            for (int a = 1; a < Dim; ++a) area *= r;
            sum += area * f(r);
        }
    return sum;
}

/// Integral of w along a line that passes the centre at the distance `away`, from `from` to `last` behind its nearest
/// place, 0 <= from. Where w is one polynomial of r = sqrt(away^2 + s^2), in either half of the range, Gauss' rule
/// still meets branch points at s = +-i away: pieces become longer with the distance from them.
template <int Dim>
double along_line(const AnyWeight<Dim>& weight, double away, double from, double last) {
    static const GaussRule table = gauss_rule(16);
    const double h = weight.range();
    double sum = 0.0;
    for (const double joint : {0.5 * h, h}) {
        if (!(joint > away)) continue;
        const double end = std::min(last, std::sqrt((joint - away) * (joint + away)));
        while (from < end) {
            const double to = std::min(end, std::max(3.0 * from, 2.0 * std::max(away, 1e-4 * h)));
            for (std::size_t k = 0; k < table->n; ++k) {
                double s = 0.0, length = 0.0;
                gsl_integration_glfixed_point(from, to, k, &s, &length, table.get());
                sum += length * weight.value(std::sqrt(away * away + s * s));
            }
            from = to;
        }
    }
    return sum;
}

/// The mean of cos(angle to x) sin(k x) over all directions of r, kr = k |r|.
template <int Dim>
double mean_wave(double kr) {
    if constexpr (Dim == 1) return std::sin(kr);
    if constexpr (Dim == 2) return std::cyl_bessel_j(1.0, kr);
    return std::sph_bessel(1U, kr);
}

/// The largest of factor(k) times integral of (-w'(r)/r) x sin kx.
template <int Dim, class Factor>
double largest_wave(const AnyWeight<Dim>& weight, const Factor& factor) {
    const double h = weight.range();
    double largest = 0.0;
    for (double kh = 0.25; kh < 16.0; kh += 0.25)
        largest = std::max(largest, factor(kh / h) * over_space<Dim>(h, [&](double r) {
                                        return r * weight.minus_slope_over_r(r) *
                                               mean_wave<Dim>(kh / h * r);
                                    }));
    return largest;
}

}  // namespace

template <int Dim>
double moment(const AnyWeight<Dim>& weight, int power) {
    return over_space<Dim>(weight.range(),
                           [&](double r) { return std::pow(r, power) * weight.value(r); });
}

template <int Dim>
double steepest_wave(const AnyWeight<Dim>& weight) {
    return largest_wave(weight, [](double) { return 1.0; });
}

template <int Dim>
double fastest_diffusion(const AnyWeight<Dim>& weight) {
    return largest_wave(weight, [](double k) { return k; });
}

template <int Dim>
double relative_step(const AnyWeight<Dim>& weight, const AnyWeight<Dim>& standard) {
    return std::min(1.0, steepest_wave(standard) / steepest_wave(weight));
}

template <int Dim>
double mean_along(const AnyWeight<Dim>& weight, const Point<Dim>& a, const Point<Dim>& b) {
    const double length = (b - a).norm();
    if (!(length > 1e-8 * weight.range())) return weight.value((0.5 * (a + b)).norm());
    const Point<Dim> along = (b - a) / length;
    const double begin = a.dot(along), end = b.dot(along);
    const Point<Dim> nearest = 0.5 * ((a - begin * along) + (b - end * along));
    const double away = nearest.norm();
    const double integral =
        begin < 0.0 && end > 0.0
            ? along_line(weight, away, 0.0, -begin) + along_line(weight, away, 0.0, end)
            : along_line(weight, away, std::min(std::abs(begin), std::abs(end)),
                         std::max(std::abs(begin), std::abs(end)));
    return integral / length;
}

#define SPAM_INSTANTIATE(D)                                                  \
    template double moment(const AnyWeight<D>&, int);                        \
    template double steepest_wave(const AnyWeight<D>&);                      \
    template double fastest_diffusion(const AnyWeight<D>&);                  \
    template double relative_step(const AnyWeight<D>&, const AnyWeight<D>&); \
    template double mean_along(const AnyWeight<D>&, const Point<D>&, const Point<D>&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

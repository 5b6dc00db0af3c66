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

/// Integral of f(r) over the line, plane or space within the range, by Gauss' rule in each half of the range: weight
/// functions are polynomials there (the cubic spline has a joint in the middle), for which it is exact.
template <int Dim, class F>
double over_space(double range, const F& f) {
    constexpr std::size_t points = 32;
    const std::unique_ptr<gsl_integration_glfixed_table,
                          decltype(&gsl_integration_glfixed_table_free)>
        table(gsl_integration_glfixed_table_alloc(points), &gsl_integration_glfixed_table_free);
    if (!table) throw std::bad_alloc();
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

template double moment(const AnyWeight<1>&, int);
template double moment(const AnyWeight<2>&, int);
template double moment(const AnyWeight<3>&, int);
template double steepest_wave(const AnyWeight<1>&);
template double steepest_wave(const AnyWeight<2>&);
template double steepest_wave(const AnyWeight<3>&);
template double fastest_diffusion(const AnyWeight<1>&);
template double fastest_diffusion(const AnyWeight<2>&);
template double fastest_diffusion(const AnyWeight<3>&);
template double relative_step(const AnyWeight<1>&, const AnyWeight<1>&);
template double relative_step(const AnyWeight<2>&, const AnyWeight<2>&);
template double relative_step(const AnyWeight<3>&, const AnyWeight<3>&);

}  // namespace spam

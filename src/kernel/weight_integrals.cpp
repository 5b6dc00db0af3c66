// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/kernel/weight_integrals.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spam {
namespace {

/// Integral of f(r) over the line, plane or space within the range, by the midpoint rule.
template <int Dim, class F>
double over_space(double range, const F& f) {
    constexpr int shells = 1000;
    const double dr = range / shells;
    const double surface = Dim == 1   ? 2.0
                           : Dim == 2 ? 2.0 * std::numbers::pi
                                      : 4.0 * std::numbers::pi;
    double sum = 0.0;
    for (int n = 0; n < shells; ++n) {
        const double r = (n + 0.5) * dr;
        double area = surface;
        for (int a = 1; a < Dim; ++a) area *= r;
        sum += area * f(r) * dr;
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
double mean_square(const AnyWeight<Dim>& weight) {
    return over_space<Dim>(weight.range(), [&](double r) { return r * r * weight.value(r); });
}

template <int Dim>
double steepest_wave(const AnyWeight<Dim>& weight) {
    return largest_wave(weight, [](double) { return 1.0; });
}

template <int Dim>
double fastest_diffusion(const AnyWeight<Dim>& weight) {
    return largest_wave(weight, [](double k) { return k; });
}

template double mean_square(const AnyWeight<1>&);
template double mean_square(const AnyWeight<2>&);
template double mean_square(const AnyWeight<3>&);
template double steepest_wave(const AnyWeight<1>&);
template double steepest_wave(const AnyWeight<2>&);
template double steepest_wave(const AnyWeight<3>&);
template double fastest_diffusion(const AnyWeight<1>&);
template double fastest_diffusion(const AnyWeight<2>&);
template double fastest_diffusion(const AnyWeight<3>&);

}  // namespace spam

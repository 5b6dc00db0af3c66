// SPDX-License-Identifier: GPL-3.0-or-later
#include "beam.hpp"

#include <spam/kernel/lucy.hpp>

#include <cmath>
#include <stdexcept>

namespace cantilever {
namespace {

constexpr double kL = 1.8751040687119611;       // cos kL cosh kL = -1
constexpr double free_kL = 4.7300407448627040;  // cos kL cosh kL = 1
// (cosh kL - cos kL)/(sinh kL - sin kL)
const double free_ratio =
    (std::cosh(free_kL) - std::cos(free_kL)) / (std::sinh(free_kL) - std::sin(free_kL));

/// Huang's frequency equation of a clamped and free beam, zero at b = omega L^2 sqrt(rho A/(E I)); b below
/// 1/(r s).
double clamped_and_free(double b, double r2, double s2) {
    const double sum = r2 + s2, difference = r2 - s2;
    const double root = std::sqrt(difference * difference + 4.0 / (b * b));
    const double alpha = std::sqrt(0.5 * (root - sum)), beta = std::sqrt(0.5 * (root + sum));
    return 2.0 +
           (b * b * difference * difference + 2.0) * std::cosh(b * alpha) * std::cos(b * beta) -
           b * sum / std::sqrt(1.0 - b * b * r2 * s2) * std::sinh(b * alpha) * std::sin(b * beta);
}

/// The same with both ends free.
double free_and_free(double b, double r2, double s2) {
    const double sum = r2 + s2, difference = r2 - s2;
    const double root = std::sqrt(difference * difference + 4.0 / (b * b));
    const double alpha = std::sqrt(0.5 * (root - sum)), beta = std::sqrt(0.5 * (root + sum));
    return 2.0 - 2.0 * std::cosh(b * alpha) * std::cos(b * beta) +
           b / std::sqrt(1.0 - b * b * r2 * s2) *
               (b * b * r2 * difference * difference + 3.0 * r2 - s2) * std::sinh(b * alpha) *
               std::sin(b * beta);
}

/// The lowest b above `start` at which an equation, positive (or `sign`) before, changes sign.
double first_root(double (*equation)(double, double, double), double start, double sign, double r2,
                  double s2) {
    double below = start, above = start;
    while (sign * equation(above, r2, s2) > 0.0) {
        below = above;
        above += 0.05;
        if (!(above * above * r2 * s2 < 1.0))
            throw std::domain_error("a plate as thick as this has no first mode of bending");
    }
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (below + above);
        (sign * equation(middle, r2, s2) > 0.0 ? below : above) = middle;
    }
    return below;
}

}  // namespace

double Beam::wave_speed() const { return std::sqrt((lambda() + 2.0 * shear_modulus()) / density); }

double Beam::thin_period() const {
    const double k = kL / length;
    return 2.0 * std::numbers::pi / (k * k * thickness * std::sqrt(modulus() / (12.0 * density)));
}

double Beam::period() const {
    const double r2 = thickness * thickness / (12.0 * length * length);
    const double s2 = r2 * modulus() / (5.0 / 6.0 * shear_modulus());
    return 2.0 * std::numbers::pi * length * length /
           (first_root(clamped_and_free, 1e-3, 1.0, r2, s2) * thickness *
            std::sqrt(modulus() / (12.0 * density)));
}

double Beam::free_period() const {
    const double r2 = thickness * thickness / (12.0 * length * length);
    const double s2 = r2 * modulus() / (5.0 / 6.0 * shear_modulus());
    const double sign = free_and_free(0.1, r2, s2) > 0.0 ? 1.0 : -1.0;
    return 2.0 * std::numbers::pi * length * length /
           (first_root(free_and_free, 0.1, sign, r2, s2) * thickness *
            std::sqrt(modulus() / (12.0 * density)));
}

double Beam::free_shape(double x) const {
    const double kx = free_kL * (x / length + 0.5);
    return 0.5 * (std::cosh(kx) + std::cos(kx) - free_ratio * (std::sinh(kx) + std::sin(kx)));
}

double Beam::free_slope(double x) const {
    const double kx = free_kL * (x / length + 0.5);
    return 0.5 * free_kL / length *
           (std::sinh(kx) - std::sin(kx) - free_ratio * (std::cosh(kx) + std::cos(kx)));
}

double Beam::shape(double x) const {
    if (x <= 0.0) return 0.0;
    const auto f = [](double kx) {
        return (std::cos(kL) + std::cosh(kL)) * (std::cosh(kx) - std::cos(kx)) +
               (std::sin(kL) - std::sinh(kL)) * (std::sinh(kx) - std::sin(kx));
    };
    return f(kL * x / length) / f(kL);
}

double layered_period(const Beam& beam, int layers, double range) {
    const spam::Lucy<2> weight(range);
    const int reach = static_cast<int>(range);
    double moment = 0.0;
    for (int k = 0; k < layers; ++k) {
        double all = 0.0, off = 0.0;
        for (int b = -std::min(reach, k); b <= std::min(reach, layers - 1 - k); ++b)
            for (int a = -reach; a <= reach; ++a) {
                const double q = weight.minus_slope_over_r(std::hypot(a, b)) * a * a;
                all += q;
                off += q * b;
            }
        const double strain = k - 0.5 * (layers - 1) + off / all;
        moment += strain * strain;
    }
    const double n = layers;
    const double longer = 1.0 + 0.5 * beam.thickness / (n * beam.length);
    return beam.period() * longer * longer / std::sqrt(12.0 * moment / (n * n * n));
}

double limit_of_doubling(double of_n, double of_2n, double of_4n) {
    return (of_n - 6.0 * of_2n + 8.0 * of_4n) / 3.0;
}

}  // namespace cantilever

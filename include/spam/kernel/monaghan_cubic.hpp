// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>
#include <spam/kernel/weight_function.hpp>

#include <cmath>
#include <numbers>

namespace spam {

/// Monaghan's cubic spline, [HH07] 3, u = r/h (other codes call h/2 the smoothing length):
///     w = A (1 - 6u^2 + 6u^3)   for u < 1/2,      A = 4/(3h), 40/(7 pi h^2), 8/(pi h^3)
///         2A (1 - u)^3          for u < 1             in 1, 2, 3 dimensions
/// Here without a branch, with p = (1 - u)+ and q = (1/2 - u)+:
///     w     = 2A (p^3 - 4 q^3)
///     -w'/r = (6A/h^2) (b^2/(1 - b) + 3q),   b = min(p, 1/2): 2 - 3u inside, (1 - u)^2/u outside
///     w''   = (12A/h^2) (p - 4q)
/// Two continuous derivatives; the third jumps at r = h/2 and r = h.
template <int Dim>
class MonaghanCubic {
  public:
    static constexpr int continuous_derivatives = 2;

    explicit MonaghanCubic(double h)
        : h_(h),
          inverse_h_(std::nextafter(1.0 / h, 2.0 / h)),  // rounded up: u >= 1 at r = h
          a_(amplitude(h)) {}

    double range() const { return h_; }

    template <class T>
    T value(const T& r) const {
        const T d = r * T(inverse_h_) - T(0.5);
        const T p = positive_part(T(0.5) - d), q = positive_part(-d);
        return T(2.0 * a_) * (p * (p * p) - T(4.0) * (q * (q * q)));
    }

    template <class T>
    T minus_slope_over_r(const T& r) const {
        const T d = r * T(inverse_h_) - T(0.5);
        const T outer = positive_part(d);  // (u - 1/2)+
        const T b = positive_part(T(0.5) - outer);
        return T(6.0 * a_ / (h_ * h_)) * (b * b / (T(0.5) + outer) + T(3.0) * (outer - d));
    }

    double second_derivative(double r) const {
        const double u = r / h_;
        const double p = positive_part(1.0 - u), q = positive_part(0.5 - u);
        return 12.0 * a_ / (h_ * h_) * (p - 4.0 * q);
    }

    double third_derivative(double r) const {
        const double u = r / h_;
        return u < 1.0 ? 12.0 * a_ / (h_ * h_ * h_) * (u < 0.5 ? 3.0 : -1.0) : 0.0;
    }

  private:
    static double amplitude(double h) {
        using std::numbers::pi;
        if constexpr (Dim == 1) return 4.0 / (3.0 * h);
        if constexpr (Dim == 2) return 40.0 / (7.0 * pi * h * h);
        return 8.0 / (pi * h * h * h);
    }
    double h_, inverse_h_, a_;
};

static_assert(SmoothWeightFunction<MonaghanCubic<1>> && SmoothWeightFunction<MonaghanCubic<2>> &&
              SmoothWeightFunction<MonaghanCubic<3>>);

}  // namespace spam

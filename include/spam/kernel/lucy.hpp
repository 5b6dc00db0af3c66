// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>
#include <spam/kernel/weight_function.hpp>

#include <cmath>
#include <numbers>

namespace spam {

/// Lucy's weight function, [HHM04] II, u = r/h:
///     w    = C (1 + 3u)(1 - u)^3,     C = 5/(4h), 5/(pi h^2), 105/(16 pi h^3) in 1, 2, 3
///     dimensions w'/r = -12 C (1 - u)^2 / h^2
///     w''  = -12 C (1 - u)(1 - 3u) / h^2,     w''' = 24 C (2 - 3u) / h^3
/// Two continuous derivatives; the third jumps at r = h.
template <int Dim>
class Lucy {
  public:
    static constexpr int continuous_derivatives = 2;

    explicit Lucy(double h) : h_(h) {
        const double c = normalisation(h);
        s_ = std::sqrt(12.0 * c) / h;
        // Rounded up, so that q is exactly zero at r = h and beyond.
        s_over_h_ = std::nextafter(s_ / h, 2.0 * s_ / h);
        constant_ = 4.0 * c / (s_ * s_ * s_);
        linear_ = 3.0 * c / (s_ * s_ * s_ * s_);
    }

    double range() const { return h_; }

    template <class T>
    T value(const T& r) const {
        const T q = scaled_rest(r);
        return (T(constant_) - T(linear_) * q) * q * (q * q);  // 1 + 3u = 4 - 3 (1 - u)
    }

    template <class T>
    T minus_slope_over_r(const T& r) const {
        const T q = scaled_rest(r);
        return q * q;
    }

    double second_derivative(double r) const {
        const double u = r / h_;
        return u < 1.0 ? -12.0 * normalisation(h_) / (h_ * h_) * (1.0 - u) * (1.0 - 3.0 * u) : 0.0;
    }

    double third_derivative(double r) const {
        const double u = r / h_;
        return u < 1.0 ? 24.0 * normalisation(h_) / (h_ * h_ * h_) * (2.0 - 3.0 * u) : 0.0;
    }

  private:
    /// s (1 - u) up to the range, with s such that its square is -w'/r: spares a factor.
    template <class T>
    T scaled_rest(const T& r) const {
        return positive_part(T(s_) - r * T(s_over_h_));
    }
    static double normalisation(double h) {
        if constexpr (Dim == 1) return 5.0 / (4.0 * h);
        if constexpr (Dim == 2) return 5.0 / (std::numbers::pi * h * h);
        return 105.0 / (16.0 * std::numbers::pi * h * h * h);
    }
    double h_, s_, s_over_h_, constant_, linear_;
};

static_assert(SmoothWeightFunction<Lucy<1>> && SmoothWeightFunction<Lucy<2>> &&
              SmoothWeightFunction<Lucy<3>>);

}  // namespace spam

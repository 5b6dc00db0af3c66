// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>
#include <spam/kernel/weight_function.hpp>

#include <numbers>

namespace spam {

/// Lucy's weight function, [HHM04] II, u = r/h:
///     w    = C (1 + 3u)(1 - u)^3,     C = 5/(4h), 5/(pi h^2), 105/(16 pi h^3) in 1, 2, 3
///     dimensions w'/r = -12 C (1 - u)^2 / h^2
/// Two continuous derivatives; the third jumps at r = h.
template <int Dim>
class Lucy {
  public:
    explicit Lucy(double h)
        : h_(h),
          inverse_h_(1.0 / h),
          c_(normalisation(h)),
          slope_(12.0 * c_ / (h * h)) {}

    double range() const { return h_; }

    template <class T>
    T value(const T& r) const {
        const T q = positive_part(T(1.0) - r * inverse_h_);
        return (T(4.0 * c_) - T(3.0 * c_) * q) * q * (q * q);  // 1 + 3u = 4 - 3q
    }

    template <class T>
    T minus_slope_over_r(const T& r) const {
        const T q = positive_part(T(1.0) - r * inverse_h_);
        return slope_ * (q * q);
    }

  private:
    static double normalisation(double h) {
        if constexpr (Dim == 1) return 5.0 / (4.0 * h);
        if constexpr (Dim == 2) return 5.0 / (std::numbers::pi * h * h);
        return 105.0 / (16.0 * std::numbers::pi * h * h * h);
    }
    double h_, inverse_h_, c_, slope_;
};

static_assert(WeightFunction<Lucy<1>> && WeightFunction<Lucy<2>> && WeightFunction<Lucy<3>>);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>
#include <spam/kernel/weight_function.hpp>

#include <cmath>
#include <numbers>

namespace spam {

/// The family w_n of [HH07] 3, u = r/h:
///     w    = C (1 + n u)(1 - u)^n,     C = (n+2)/(4h), (n+2)(n+3)/(6 pi h^2),
///                                          (n+2)(n+3)(n+4)/(32 pi h^3) in 1, 2, 3 dimensions
///     w'/r = -K (1 - u)^(n-1),         K = C n (n+1)/h^2
///     w''  = -K (1 - u)^(n-2) (1 - n u),   w''' = K (n-1) (1 - u)^(n-3) (2 - n u)/h
/// n - 1 continuous derivatives, the next jumps at r = h. n = 3 is Lucy; larger n are smoother, and
/// narrower at the same range.
template <int Dim, int N>
class Wn {
    static_assert(N >= 2, "w_1 has no continuous derivative: forces would jump at the range");

  public:
    static constexpr int continuous_derivatives = N - 1;

    explicit Wn(double h) : h_(h) {
        const double c = normalisation(h);
        steepness_ = c * N * (N + 1) / (h * h);
        s_ = std::pow(steepness_, 1.0 / (N - 1));
        // Rounded up, so that q is exactly zero at r = h and beyond.
        s_over_h_ = std::nextafter(s_ / h, 2.0 * s_ / h);
        constant_ = (N + 1) * c / power<N>(s_);
        linear_ = N * c / power<N + 1>(s_);
    }

    double range() const { return h_; }

    template <class T>
    T value(const T& r) const {
        const T q = scaled_rest(r);
        return (T(constant_) - T(linear_) * q) * power<N>(q);  // 1 + n u = n + 1 - n (1 - u)
    }

    template <class T>
    T minus_slope_over_r(const T& r) const {
        return power<N - 1>(scaled_rest(r));
    }

    double second_derivative(double r) const {
        const double u = r / h_;
        return u < 1.0 ? -steepness_ * power<N - 2>(1.0 - u) * (1.0 - N * u) : 0.0;
    }

    double third_derivative(double r) const {
        const double u = r / h_;
        if (u >= 1.0) return 0.0;
        if constexpr (N == 2)
            return 2.0 * steepness_ / h_;  // (2 - 2u)/(1 - u)
        else
            return (N - 1) * steepness_ / h_ * power<(N > 2 ? N - 3 : 0)>(1.0 - u) * (2.0 - N * u);
    }

  private:
    template <int P, class T>
    static T power(const T& x) {
        if constexpr (P == 0)
            return T(1.0);
        else if constexpr (P == 1)
            return x;
        else if constexpr (P % 2 == 0)
            return power<P / 2>(x * x);
        else
            return x * power<P - 1>(x);
    }
    /// s (1 - u) up to the range, with s such that its power n - 1 is -w'/r: spares a factor.
    template <class T>
    T scaled_rest(const T& r) const {
        return positive_part(T(s_) - r * T(s_over_h_));
    }
    static double normalisation(double h) {
        using std::numbers::pi;
        if constexpr (Dim == 1) return (N + 2) / (4.0 * h);
        if constexpr (Dim == 2) return (N + 2) * (N + 3) / (6.0 * pi * h * h);
        return (N + 2) * (N + 3) * (N + 4) / (32.0 * pi * h * h * h);
    }
    double h_, steepness_, s_, s_over_h_, constant_, linear_;
};

static_assert(SmoothWeightFunction<Wn<1, 2>> && SmoothWeightFunction<Wn<2, 4>> &&
              SmoothWeightFunction<Wn<3, 5>>);

}  // namespace spam

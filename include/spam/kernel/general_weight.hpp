// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/vec.hpp>
#include <spam/kernel/kernel.hpp>

#include <array>

namespace spam {

/// Every weight function of this room in one formula without a branch, for sweeps that are to be
/// compiled once and not for each of them. With u = r/h, p = (1 - u)+ and q = (1/2 - u)+ they are
///     w     = p^2 sum_k a_k p^k - m q^3
///     -w'/r = p sum_k b_k p^k + g (b^2/(1 - b) + 3q),   b = min(p, 1/2)
///     w''   = sum_k c_k p^k - s q
///     w'''  = sum_k d_k p^k
/// where m, g and s are zero except for Monaghan's spline (formulas of monaghan_cubic.hpp), and for
/// w_n two terms, one, two and two of the sums are not (wn.hpp). About twice the operations of Lucy's
/// own formula. All are exactly zero from the range on, w'' and w''' where the law has 2 and 3
/// continuous derivatives; else they must not be asked for.
template <int Dim>
class GeneralWeight {
  public:
    /// Throws InputError for a range that is not above 0.
    GeneralWeight(Kernel kernel, double range);

    int continuous_derivatives;

    double range() const { return h_; }

    template <class T>
    T value(const T& r) const {
        const T p = rest(r), q = positive_part(p - T(0.5));
        return p * p * polynomial(value_, p) - T(spline_value_) * (q * (q * q));
    }
    template <class T>
    T minus_slope_over_r(const T& r) const {
        const T p = rest(r), q = positive_part(p - T(0.5));
        const T b = p - q;  // min(p, 1/2)
        return p * polynomial(slope_, p) + T(spline_slope_) * (b * b / (T(1.0) - b) + T(3.0) * q);
    }
    template <class T>
    T second_derivative(const T& r) const {
        const T p = rest(r);
        return polynomial(second_, p) - T(spline_second_) * positive_part(p - T(0.5));
    }
    template <class T>
    T third_derivative(const T& r) const {
        return polynomial(third_, rest(r));
    }

  private:
    template <std::size_t N>
    using Coefficients = std::array<double, N>;

    /// p
    template <class T>
    T rest(const T& r) const {
        return positive_part(T(1.0) - r * T(inverse_h_));
    }
    /// Horner: where leading or trailing coefficients are zero no digit is lost.
    template <std::size_t N, class T>
    static T polynomial(const Coefficients<N>& c, const T& p) {
        T sum(c[N - 1]);
        for (std::size_t k = N - 1; k-- > 0;) sum = sum * p + T(c[k]);
        return sum;
    }
    void set_family(int n);
    void set_monaghan();

    double h_, inverse_h_;
    double spline_value_ = 0.0, spline_slope_ = 0.0, spline_second_ = 0.0;
    Coefficients<8> value_{};
    Coefficients<7> slope_{};
    Coefficients<8> second_{};
    Coefficients<7> third_{};
};

SPAM_COMPILED(extern template class GeneralWeight);

}  // namespace spam

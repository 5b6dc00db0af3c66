// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/weight_function.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace spam {

/// Any weight function as a value: a virtual call for every distance, so for set-up, measurements and
/// pictures. Right-hand sides are compiled for the law itself.
template <int Dim>
class AnyWeight {
  public:
    /// Implicit, so that a function can be given the law itself.
    template <SmoothWeightFunction W>
    requires(!std::same_as<W, AnyWeight>) AnyWeight(const W& w)
        : continuous_derivatives(w.continuous_derivatives),
          law_(std::make_shared<Held<W>>(w)) {}

    int continuous_derivatives;

    double range() const { return law_->range(); }
    double value(double r) const { return law_->value(r); }
    double minus_slope_over_r(double r) const { return law_->minus_slope_over_r(r); }
    double second_derivative(double r) const { return law_->second_derivative(r); }
    double third_derivative(double r) const { return law_->third_derivative(r); }

  private:
    struct Law {
        virtual ~Law() = default;
        virtual double range() const = 0;
        virtual double value(double r) const = 0;
        virtual double minus_slope_over_r(double r) const = 0;
        virtual double second_derivative(double r) const = 0;
        virtual double third_derivative(double r) const = 0;
    };

    template <class W>
    struct Held final : Law {
        explicit Held(const W& weight) : w(weight) {}
        double range() const override { return w.range(); }
        double value(double r) const override { return w.value(r); }
        double minus_slope_over_r(double r) const override { return w.minus_slope_over_r(r); }
        double second_derivative(double r) const override { return w.second_derivative(r); }
        double third_derivative(double r) const override { return w.third_derivative(r); }
        W w;
    };

    std::shared_ptr<const Law> law_;
};

/// The weight function an option names: lucy, monaghan, or w2 to w8 (w_n). Throws InputError for other
/// names and for a range that is not above 0.
template <int Dim>
AnyWeight<Dim> weight_function(std::string_view name, double range);

}  // namespace spam

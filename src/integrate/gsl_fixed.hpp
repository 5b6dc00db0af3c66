// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fixed_steps.hpp"
#include "gsl_stepper.hpp"

namespace spam {

/// A Runge-Kutta method of the GSL with a fixed step. Its error estimates are not used.
class GslFixed final : public FixedSteps {
  public:
    GslFixed(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0)
        : FixedSteps(ode, y, t0, *options.dt),
          stepper_(options.method, ode, options.rtol, statistics_.rhs_evaluations),
          y_dot_(y.clone()) {}

  private:
    void begin() override { rates(t_, y_, y_dot_); }
    void advance(double h) override;

    GslStepper stepper_;
    Vector y_dot_;
};

}  // namespace spam

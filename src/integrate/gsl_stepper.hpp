// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>

#include <gsl/gsl_odeiv2.h>

#include <exception>
#include <memory>

namespace spam {

/// An explicit stepper of the GSL, bound to an ode: one attempt at a step, and what GSL's control thinks
/// of it.
class GslStepper {
  public:
    /// `method`: gsl:<name>. `evaluations` counts right-hand sides.
    GslStepper(const std::string& method, const Ode& ode, double rtol, std::size_t& evaluations);

    /// y <- the state after h from (t, y), or no matter what where that has no meaning; `y_dot` holds
    /// the rates at (t, y), null for a multistep method. Returns whether it has.
    bool attempt(double t, double h, std::span<double> y, const double* y_dot);
    /// When the rates latest had no meaning.
    double failed_at() const { return failed_at_; }
    /// Of the latest attempt, entry by entry.
    std::span<const double> error() const { return error_; }

    /// Whether no entry k of the error is larger than 1.1 (rtol |y_k| + atol_k), y the state after the
    /// latest attempt. Changes h, its length, to what should be tried next.
    bool accepts(std::span<const double> y, double& h);

    /// Forgets all earlier steps.
    void reset();

  private:
    static int rates(double t, const double y[], double y_dot[], void* self);

    const Ode& ode_;
    std::size_t& evaluations_;
    gsl_odeiv2_system system_;
    struct Free {
        void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
    };
    std::unique_ptr<gsl_odeiv2_driver, Free> driver_;
    std::vector<double> error_;
    double failed_at_ = 0.0;
    std::exception_ptr thrown_;
};

}  // namespace spam

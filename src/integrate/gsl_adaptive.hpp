// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "error_shares.hpp"
#include "event_watch.hpp"
#include "gsl_stepper.hpp"

namespace spam {

/// An explicit method of the GSL that chooses its steps. A step is accepted where no entry k of its
/// error estimate is larger than 1.1 (rtol |y_k| + atol_k), y after the step: the worst entry decides,
/// not the mean of all as with SUNDIALS, so that the same tolerances ask for more. Steps change by
/// factors of 1/5 to 5; one without meaning is tried again at half its length.
/// gsl:msadams, of orders 1 to 12, goes on from earlier steps: see Cvode for what that means.
class GslAdaptive final : public Integrator {
  public:
    GslAdaptive(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0);
    bool lands_on_stops() const override { return true; }
    void reset(double t) override;
    void remember(Archive& archive) override;

  private:
    double take_step(double t_stop) override;
    void begin();
    double first_step();
    struct Accepted {
        double length, to;
    };
    Accepted accepted_step(double t_stop);
    void reject(bool meaningful, double tried);
    std::span<const double> retake(double h);
    void estimate_errors();

    IntegratorOptions options_;
    bool multistep_;
    GslStepper stepper_;
    ErrorShares shares_;
    EventWatch watch_;
    Vector z_, y_dot_;
    double h_ = 0.0;  ///< to be tried next; 0 before the first step
};

}  // namespace spam

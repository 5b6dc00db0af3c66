// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvode_corrector.hpp"
#include "error_shares.hpp"
#include "sundials_messages.hpp"
#include <spam/integrate/integrator.hpp>

#include <exception>
#include <memory>

namespace spam {

/// CVODE's multistep methods in steps of their own choice. cvode:adams: Adams-Moulton of orders 1 to 12, corrected by
/// fixed-point iteration: little more than one right-hand side a step, however high the order. cvode:bdf: backward
/// differences of orders 1 to 5, corrected by Newton's method (CvodeCorrector): steps as long as the solution is
/// smooth, however fast what has decayed would. A step is accepted where the root mean square over all entries k of
/// e_k / (rtol |y_k| + atol_k) is at most 1. It goes on from several steps before: after a reset, and at every
/// checkpoint, it begins anew with order 1 and small steps. Events, after which no earlier step counts and before
/// which a step would have to be taken again with another length, are refused: where they are rare a one-step method
/// is no slower, where they are not this one never leaves order 1.
class Cvode final : public Integrator {
  public:
    Cvode(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0,
          const SundialsContext& context);
    ~Cvode() override;
    bool lands_on_stops() const override { return true; }
    void reset(double t) override;
    void remember(Archive& archive) override;

  private:
    double take_step(double t_stop) override;
    void create();
    void destroy();
    void check(int flag, const char* call) const;
    [[noreturn]] void stop(int flag);
    void estimate_errors();
    void count();
    static int rates(double t, N_Vector y, N_Vector y_dot, void* self);

    IntegratorOptions options_;
    const SundialsContext& context_;
    std::size_t rejected_before_ = 0;  ///< by the memory in use before
    Vector accepted_;  ///< y of the last accepted step: a failure may leave y overwritten
    Vector local_error_, weight_;
    ErrorShares shares_;
    void* memory_ = nullptr;
    std::unique_ptr<CvodeCorrector> corrector_;
    SundialsMessages messages_;
    std::exception_ptr error_;
};

}  // namespace spam

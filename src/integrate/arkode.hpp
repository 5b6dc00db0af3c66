// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "arkode_control.hpp"
#include "error_shares.hpp"
#include "event_watch.hpp"
#include "fixed_grid.hpp"
#include "sundials_messages.hpp"

#include <exception>

namespace spam {

/// An explicit Runge-Kutta method of ARKODE, adaptive or with a fixed step. A step is accepted where
/// the root mean square over all entries k of e_k / (rtol |y_k| + atol_k) is at most 1; e is the
/// difference to the embedded method, y the state before the step.
///
/// With relaxation a step from (t, y) by (h, d) ends at (t + gamma h, y + gamma d), gamma near 1 such that
/// E(y + gamma d) = E(y): relaxation Runge-Kutta. A step that must end at a certain time is aimed a hundredth
/// short of it, and the rest is a step that is not rescaled.
class Arkode final : public Integrator {
  public:
    Arkode(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0,
           const SundialsContext& context);
    ~Arkode() override;
    bool lands_on_stops() const override { return !dt_; }
    void reset(double t) override;
    void remember(Archive& archive) override;

  private:
    struct Calls;  // the ERKStep and ARKStep flavours of one ARKODE call

    double take_step(double t_stop) override;
    void check(int flag, const char* call) const;
    /// What came of a step: where it ended, or why it is none.
    struct Attempt {
        double reached;
        std::string why_not;
    };
    Attempt attempt(double t_stop);
    std::string reason_of(int flag);
    double evolve(double t_stop);
    std::string find_non_finite_rate(double h);
    std::span<const double> retake(double h);
    double take_fixed(double from, const Vector& y, double h);
    void take_piece(double h, double t_next);
    void restart(double h);
    void estimate_errors();
    static int rates(double t, N_Vector y, N_Vector y_dot, void* self);

    // arkode_relaxation.cpp
    void set_relaxation();
    void relax(bool on);
    double short_of(double t_stop) const;
    double stop_for_relaxed(double t_stop) const;
    bool almost_at(double t_stop, double reached) const;
    std::span<const double> retake_relaxed(double h);
    void close_gap(double reached, double to);
    void land(double reached, double t_stop);
    long relaxations_failed() const;
    static int energy(N_Vector y, double* energy, void* self);
    static int energy_gradient(N_Vector y, N_Vector gradient, void* self);

    double step_ahead() const;
    void create();
    void set_step_control();

    IntegratorOptions options_;
    const SundialsContext& context_;
    std::optional<double> dt_;
    FixedGrid grid_;                   ///< used where dt_ is set
    std::size_t rejected_before_ = 0;  ///< by the memory in use before
    bool retaking_ = false;            ///< ARKODE has the length of a step taken again
    bool erk_ = true;                  ///< the method runs in ERKStep, not ARKStep
    double first_step_ = 0.0;          ///< that ARKODE was told to begin with; 0 once it has
    Vector accepted_;  ///< y of the last accepted step: an ARKODE failure may leave y overwritten
    Vector local_error_, weight_;  ///< of the latest adaptive step
    ErrorShares shares_;
    EventWatch watch_;
    const Calls* calls_ = nullptr;
    KeptController controller_;
    void* memory_ = nullptr;
    SundialsMessages messages_;
    std::string failure_;        ///< of the ode, the first of the latest attempt with any
    bool checks_rates_ = false;  ///< whether they are finite
    std::string non_finite_;     ///< the first rate in this step that is not
    std::exception_ptr error_;
};

}  // namespace spam

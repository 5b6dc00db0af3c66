// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "event_watch.hpp"
#include "fixed_grid.hpp"

namespace spam {

/// What our one-step methods with a fixed step share: the grid t_n = t_0 + n dt, steps in pieces where
/// events are due, the guard. A method says how to begin and how to advance.
class FixedSteps : public Integrator {
  public:
    FixedSteps(const Ode& ode, Vector& y, double t0, double dt);
    bool lands_on_stops() const final { return false; }
    void reset(double t) override;
    void remember(Archive& archive) override;

  protected:
    /// A step, or the rest of one, begins at (t_, y_).
    virtual void begin() = 0;
    /// z_ = the state after h from there; may be called again with other lengths.
    virtual void advance(double h) = 0;
    /// What z_ was advanced to last is the state now; begin() comes next.
    virtual void accept() {}
    /// Where advance(h) led to what is not finite: the first rates that were not, in words.
    virtual std::string non_finite_stage(double) const { return {}; }
    /// y is no longer what the method left there: nothing known of it holds.
    virtual void forget() {}

    /// y_dot = f(t, at). Throws GuardStop where that has no meaning.
    void rates(double t, const Vector& at, Vector& y_dot);
    /// Throws GuardStop for that reason at t, in all parts of the run.
    [[noreturn]] void stop(const std::string& reason, double t);

    Vector z_;

  private:
    double take_step(double t_stop) final;
    std::span<const double> guarded(double h);
    void take_pieces(double h, double t_next);

    FixedGrid grid_;
    EventWatch watch_;
};

}  // namespace spam

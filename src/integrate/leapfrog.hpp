// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fixed_steps.hpp"
#include "separable.hpp"

namespace spam {

/// Velocity Verlet, kick - drift - kick, with a fixed step, of order 2:
///     v' = v + h/2 a(x),   x <- x + h v',   v <- v' + h/2 a(x).
/// Symplectic and reversible: the energy error of a conservative system stays bounded, about
/// (omega dt)^2, instead of growing, and linear and angular momentum are kept to round-off. One
/// right-hand side a step: the last acceleration is kept. Needs dx/dt = v and dv/dt = a(x), nothing
/// else in y. Throws InputError with the reason where the ode is not such.
class Leapfrog final : public FixedSteps {
  public:
    Leapfrog(const Ode& ode, Vector& y, double t0, double dt);

  private:
    void begin() override;
    void advance(double h) override;
    void accept() override { std::swap(a_, a_end_); }
    void forget() override { known_ = false; }

    SeparableBlocks at_;
    Vector a_, a_end_;    ///< rates at y_ and z_, of which the accelerations count
    bool known_ = false;  ///< a_ is that of y_
};

}  // namespace spam

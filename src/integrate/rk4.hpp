// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fixed_steps.hpp"

#include <array>

namespace spam {

/// Classical fourth-order Runge-Kutta with a fixed step, the method of [HHM04] VI, on N_Vector
/// operations.
class Rk4 final : public FixedSteps {
  public:
    Rk4(const Ode& ode, Vector& y, double t0, double dt);

  private:
    void begin() override { rates(t_, y_, k_[0]); }
    void advance(double h) override;
    std::string non_finite_stage(double h) const override;

    std::array<Vector, 4> k_;
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fixed_steps.hpp"
#include "separable.hpp"
#include <spam/integrate/methods.hpp>

namespace spam {

/// Symplectic partitioned Runge-Kutta with a fixed step, by the tables of SUNDIALS 6.6 and later. For
/// every stage i, at the time the positions have reached,
///     v <- v + h ahat_i a(x),   x <- x + h a_i v.
/// Symplectic as Leapfrog is. The tables are run here and not by SPRKStep, which would evaluate the
/// whole right-hand side twice a stage, once for each half. Throws InputError where y is not (x, v).
class Sprk final : public FixedSteps {
  public:
    Sprk(const IntegratorOptions& options, const Ode& ode, Vector& y, double t0);

  private:
    void begin() override {}
    void advance(double h) override;

    struct Stage {
        double kick, drift;
    };
    std::vector<Stage> stages_;
    SeparableBlocks at_;
    Vector rates_;
};

/// The tables of the SUNDIALS in use, as sprk:<name without ARKODE_SPRK_>; none before 6.6.
std::vector<IntegrationMethod> sprk_methods();

}  // namespace spam

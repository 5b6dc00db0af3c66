// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "event_watch.hpp"
#include "fixed_grid.hpp"

#include <array>

namespace spam {

/// Classical fourth-order Runge-Kutta with a fixed step, the method of [HHM04] VI, on N_Vector
/// operations. t_n = t_0 + n dt without accumulation.
class Rk4 final : public Integrator {
  public:
    Rk4(const Ode& ode, Vector& y, double t0, double dt);
    double step(double t_stop) override;
    bool lands_on_stops() const override { return false; }
    void reset(double t) override;
    void remember(Archive& archive) override;

  private:
    void stage(double t, const Vector& at, std::size_t k);
    std::span<const double> advance(double h);
    void take_pieces(double h, double t_next);

    FixedGrid grid_;
    std::array<Vector, 4> k_;
    Vector z_;
    EventWatch watch_;
};

}  // namespace spam

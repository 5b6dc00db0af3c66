// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/archive.hpp>

#include <cmath>

namespace spam {

/// The times of fixed steps, t_n = t_0 + n dt without accumulation. A stop within a rounding error of a
/// grid time is that grid time, and the step to it as long as all others: whether a run ends there or
/// goes on, later restarted or not, makes no difference to y.
class FixedGrid {
  public:
    FixedGrid(double t0, double dt) : t0_(t0), dt_(dt) {}

    struct Step {
        double length, to;
        bool whole;  ///< it ends at a time of the grid to the last bit: no stop had an influence
    };
    /// The step from t to the next grid time, or a shorter one to t_stop.
    Step next(double t, double t_stop) const {
        const double grid = time(n_ + 1);
        const double to = grid >= t_stop - slack() ? t_stop : grid;
        const bool on_grid = near(t, time(n_)) && near(to, grid);
        return {on_grid ? dt_ : to - t, to, to == grid};
    }
    /// After that step, at step.to.
    void arrive(const Step& step) {
        ++n_;
        if (!near(step.to, time(n_))) begin(step.to);
    }
    /// y has changed at t. A time of the grid stays one: where something changes after every step, times would
    /// accumulate.
    void reset(double t) {
        if (!near(t, time(n_))) begin(t);
    }

    void remember(Archive& archive) { archive(t0_, n_); }

  private:
    void begin(double t) {
        t0_ = t;
        n_ = 0;
    }
    double time(std::size_t n) const { return t0_ + static_cast<double>(n) * dt_; }
    double slack() const { return 1e-9 * dt_; }
    bool near(double a, double b) const { return std::abs(a - b) <= slack(); }

    double t0_, dt_;
    std::size_t n_ = 0;
};

}  // namespace spam

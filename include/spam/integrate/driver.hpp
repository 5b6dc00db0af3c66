// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>

namespace spam {

/// When a run ends and when its observers are called.
struct Schedule {
    double t_end = 0.0;
    double output_every = 0.0;      ///< rows of invariants; t = 0 and t_end always
    double snapshot_every = 0.0;    ///< configurations; t = 0 and t_end always
    double checkpoint_every = 0.0;  ///< 0: never
    double change_every = 0.0;      ///< changes of the number of particles; 0: never
    double start = 0.0;             ///< intervals are counted from here
    bool resumed = false;           ///< what was due up to the integrator's time has been done
};

/// Observers of a run; any may be empty. `output` and `snapshot` see accepted states only.
struct Observers {
    std::function<void(double t)> output;
    std::function<void(double t)> snapshot;
    std::function<void(double t)> step;  ///< after every step: progress
    /// After every output: whether y was changed, or the rates, so that the integrator begins anew.
    std::function<bool(double t)> revise;
    /// At its times: what has been made of the run's y with other particles goes on from there, by another integrator.
    /// Not where a run ends off its schedule: one with a later end would not pass through that state.
    std::function<void(double t)> change;
    /// After all else at a time of the schedule: a run that goes on from here later is the same, bit
    /// for bit, as one that was never stopped. May change what the integrator remembers.
    std::function<void(double t)> checkpoint;
    /// Where the run ends at a state that is none of those, by a signal, a guard, enough, or a t_end off
    /// the schedule: before what is observed only because it ends.
    std::function<void(double t)> last;
    /// After every output: whether the run has shown what it was for and ends here.
    std::function<bool(double t)> enough;
};

/// Times k * every, each due once: exactly hit by integrators that land on stops, at the first step
/// not before it by the others.
class DueTimes {
  public:
    DueTimes(double every, double t0) : every_(every), t0_(t0) {}
    double next() const { return t0_ + static_cast<double>(k_) * every_; }
    /// Whether t has reached the next due time (within a rounding error); if so moves past t.
    bool reached(double t, double slack);

  private:
    double every_, t0_;
    std::size_t k_ = 1;
};

/// Integrates to schedule.t_end, or until there is enough, calling observers at t = start, when due, and at the end.
/// Returns the signal that interrupted the run (see InterruptWatch), 0 if it went to the end.
/// GuardStop, of a step or an observer, passes through.
/// In every case the final accepted state has been given to `output` and `snapshot` exactly once.
/// `integrator` may be another one after an observer was called.
int drive(const std::function<Integrator&()>& integrator, const Schedule& schedule,
          const Observers& observers);
inline int drive(Integrator& integrator, const Schedule& schedule, const Observers& observers) {
    return drive([&]() -> Integrator& { return integrator; }, schedule, observers);
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/integrate/driver.hpp>
#include <spam/integrate/interrupt.hpp>

#include <algorithm>
#include <limits>

namespace spam {
namespace {

/// Calls an observer at most once per time.
class Once {
  public:
    explicit Once(const std::function<void(double)>& observer) : observer_(observer) {}
    void operator()(double t) {
        if (!observer_ || t == last_) return;
        last_ = t;
        observer_(t);
    }

  private:
    const std::function<void(double)>& observer_;
    double last_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

bool DueTimes::reached(double t, double slack) {
    if (t < next() - slack) return false;
    k_ = std::max(k_ + 1, static_cast<std::size_t>(std::min(1e18, (t - t0_ + slack) / every_)));
    while (t >= next() - slack) ++k_;
    return true;
}

int drive(Integrator& integrator, const Schedule& schedule, const Observers& observers) {
    Once output(observers.output), snapshot(observers.snapshot);
    DueTimes output_due(schedule.output_every, integrator.t());
    DueTimes snapshot_due(schedule.snapshot_every, integrator.t());
    output(integrator.t());
    snapshot(integrator.t());
    try {
        while (integrator.t() < schedule.t_end && InterruptWatch::received() == 0) {
            double stop = schedule.t_end;
            const double slack = 1e-9 * std::min(schedule.output_every, schedule.snapshot_every);
            if (integrator.lands_on_stops()) {
                stop = std::min({stop, output_due.next(), snapshot_due.next()});
                if (schedule.t_end - stop < slack) stop = schedule.t_end;
            }
            const double t = integrator.step(stop);
            const bool row = output_due.reached(t, slack);
            if (row) output(t);
            if (snapshot_due.reached(t, slack)) snapshot(t);
            if (observers.step) observers.step(t);
            if (row && observers.enough && observers.enough(t)) break;
            if (row && observers.revise && observers.revise(t)) integrator.reset(t);
        }
        output(integrator.t());
        snapshot(integrator.t());
    } catch (const GuardStop&) {
        output(integrator.t());
        snapshot(integrator.t());
        throw;
    }
    return InterruptWatch::received();
}

}  // namespace spam

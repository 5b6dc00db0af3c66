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

/// The stops of a schedule that are still to come.
struct Stops {
    const Schedule& schedule;
    DueTimes output, snapshot, checkpoint, change;
    double slack;

    explicit Stops(const Schedule& s)
        : schedule(s),
          output(s.output_every, s.start),
          snapshot(s.snapshot_every, s.start),
          checkpoint(or_never(s.checkpoint_every), s.start),
          change(or_never(s.change_every), s.start),
          slack(1e-9 * std::min({s.output_every, s.snapshot_every, s.t_end - s.start})) {
        for (const double every : {s.checkpoint_every, s.change_every})
            if (every > 0.0) slack = std::min(slack, 1e-9 * every);
    }

    static double or_never(double every) {
        return every > 0.0 ? every : std::numeric_limits<double>::infinity();
    }
    double due() const {
        return std::min({output.next(), snapshot.next(), checkpoint.next(), change.next()});
    }
    double next() const { return schedule.t_end - due() < slack ? schedule.t_end : due(); }
    void skip(double t) {
        for (DueTimes* due : {&output, &snapshot, &checkpoint, &change}) due->reached(t, slack);
    }
};

}  // namespace

bool DueTimes::reached(double t, double slack) {
    if (t < next() - slack) return false;
    // Beyond the last count there are no more times, whatever t is.
    constexpr double last = 1e18;
    k_ = std::max(k_ + 1, static_cast<std::size_t>(std::min(last, (t - t0_ + slack) / every_)));
    while (k_ < static_cast<std::size_t>(last) && t >= next() - slack) ++k_;
    return true;
}

int drive(const std::function<Integrator&()>& integrator, const Schedule& schedule,
          const Observers& observers) {
    Once output(observers.output), snapshot(observers.snapshot);
    Stops stops(schedule);
    // Before the first row: a signal between it and the first snapshot would leave half a file.
    InterruptWatch::complete_results();
    bool at_checkpoint = schedule.resumed;  // whether (t, y) is that of the latest checkpoint
    const auto finish = [&](double t) {
        if (!at_checkpoint && observers.last) observers.last(t);
        output(t);
        snapshot(t);
    };
    if (schedule.resumed) {
        stops.skip(integrator().t());
        if (observers.enough && observers.enough(integrator().t())) {
            finish(integrator().t());
            return 0;
        }
    } else {
        output(integrator().t());
        snapshot(integrator().t());
    }
    try {
        // Parts meet here, so that one that ends between steps (an observer throws) ends no step of others half-way.
        while (integrator().t() < schedule.t_end && InterruptWatch::agreed() == 0) {
            // Where this step would end if the run had a later end: only such states are checkpoints,
            // because a run with that end must pass through them.
            const double due = stops.due();
            at_checkpoint = false;
            const double t =
                integrator().step(integrator().lands_on_stops() ? stops.next() : schedule.t_end);
            const bool regular = integrator().lands_on_stops() ? t < schedule.t_end || t == due
                                                               : integrator().whole_step();
            const bool row = stops.output.reached(t, stops.slack);
            if (row) output(t);
            if (stops.snapshot.reached(t, stops.slack)) snapshot(t);
            if (observers.step) observers.step(t);
            if (row && observers.enough && observers.enough(t)) break;
            if (row && observers.revise && observers.revise(t)) integrator().reset(t);
            if (stops.change.reached(t, stops.slack) && regular && observers.change)
                observers.change(t);
            if (stops.checkpoint.reached(t, stops.slack) && regular && observers.checkpoint) {
                observers.checkpoint(t);
                at_checkpoint = true;
            }
        }
        finish(integrator().t());
    } catch (const GuardStop&) {
        finish(integrator().t());
        throw;
    }
    return InterruptWatch::agreed();
}

}  // namespace spam

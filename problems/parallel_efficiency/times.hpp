// SPDX-License-Identifier: GPL-3.0-or-later
// What steps take on one process and on several.
#pragma once

#include <spam/problem/parted_motion.hpp>

#include <chrono>
#include <cmath>
#include <ctime>
#include <optional>

namespace parallel_efficiency {

using namespace spam;

/// Seconds a step: `busy` of the processor outside of exchanges, in the quickest exchanges, and of the clock.
struct Times {
    double busy = HUGE_VAL, exchanges = HUGE_VAL, clock = HUGE_VAL;

    double without_others() const { return busy + exchanges; }
    void keep_least(const Times& other) {
        busy = std::min(busy, other.busy);
        exchanges = std::min(exchanges, other.exchanges);
        clock = std::min(clock, other.clock);
    }
};

/// The exchanges of others, whose processor time is taken.
class Timed final : public Parts {
  public:
    explicit Timed(Parts& others) : Parts(others.count(), others.own()), others_(others) {}
    double processor_seconds = 0.0;

  private:
    std::vector<Bytes> transport(std::vector<Bytes> to, Content content) override {
        const std::clock_t begin = std::clock();
        auto from = others_.exchange(std::move(to), content);
        processor_seconds += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        return from;
    }
    Parts& others_;
};

/// A turn of this process, which moves a part or, alone, the whole.
inline Times turn_of(Timed& all, PartedMotion<2>& motion, int steps) {
    Parts& parts = motion.processes();
    const Parts::Here here(parts);
    parts.agree();
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t busy = std::clock();
    const double exchanging = all.processor_seconds;
    Times times;
    for (int k = 0; k < steps; ++k) {
        const double so_far = parts.traffic().seconds;
        motion.integrator().step(1e100);
        times.exchanges = std::min(times.exchanges, parts.traffic().seconds - so_far);
    }
    times.busy = (static_cast<double>(std::clock() - busy) / CLOCKS_PER_SEC -
                  (all.processor_seconds - exchanging)) /
                 steps;
    times.clock =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / steps;
    return times;
}

/// The first process alone; the others wait, and all know what it found.
inline Times alone(Timed& all, std::optional<PartedMotion<2>>& motion, int steps) {
    const Times own = motion ? turn_of(all, *motion, steps) : Times{};
    const auto known = all.gather(std::span<const Times>(&own, 1));
    return known.front().front();
}

/// The busiest process waits least.
inline Times together(Timed& all, PartedMotion<2>& motion, int steps) {
    const Times own = turn_of(all, motion, steps);
    return {all.most(own.busy), -all.most(-own.exchanges), all.most(own.clock)};
}

}  // namespace parallel_efficiency

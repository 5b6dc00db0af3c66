// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/archive.hpp>

#include <functional>
#include <span>
#include <string>

namespace spam {

/// Something that happens to y at one time, between the steps of an integrator: a jump that is no
/// part of dy/dt. Integrators find the time, end a step there, apply the event and begin anew.
struct Event {
    std::string name;  ///< for messages: "closest approach"

    /// A step, or the rest of one after an event, begins at (t, y): what can happen in it. After that
    /// the distance at (t, y) must be positive (infinite where nothing can happen); one that is not is
    /// due at once. May be empty where the distance sees to that alone.
    std::function<void(double t, std::span<const double> y)> arm;

    /// Falls through zero when the event is due, in any unit; continuous along the solution since
    /// arm(). -infinity: the step is too long to tell; a shorter one is tried, and ends without an
    /// event where that says that none is due.
    std::function<double(double t, std::span<const double> y)> distance;

    /// How near zero, on the positive side, the distance must come: 0 < distance <= tolerance there.
    double tolerance = 1e-12;

    /// Changes y, with 0 < distance <= tolerance but for rounding. Returns how often the event has
    /// happened: more than once where several are due together, 0 where it was a false alarm.
    std::function<std::size_t(double t, std::span<double> y)> apply;

    /// What it knows of earlier steps and cannot find in y. May be empty.
    std::function<void(Archive&)> remember{};
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_watch.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t most_in_step = 10'000, most_at_once = 100;

}  // namespace

void EventWatch::begin(double t, std::span<const double> y) {
    t_ = t;
    y_ = y;
    for (const Event& event : events_)
        if (event.arm) event.arm(t, y);
}

/// Of the nearest event, in units of its tolerance.
double EventWatch::distance(double t, std::span<const double> y) const {
    double least = infinity;
    for (const Event& event : events_)
        least = std::min(least, event.distance(t, y) / event.tolerance);
    return least;
}

EventWatch::Piece EventWatch::first_piece(double h, std::span<const double> z,
                                          const Retake& retake) {
    whole_ = h;
    if (events_.empty()) return {h, false};
    double at_h = distance(t_ + h, z);
    if (at_h > 0.0) return {h, false};
    while (at_h == -infinity) {
        h *= 0.5;
        if (t_ + h == t_)
            throw GuardStop(fmt::format("no step is short enough to watch {} at t = {:.6g}",
                                        events_.front().name, t_));
        at_h = distance(t_ + h, retake(h));
        if (at_h > 0.0) return {h, false};
    }
    return locate(h, at_h, retake);
}

/// The distance is positive at 0 and is not at h. Looks for a length where it is in (0, 1], aiming at
/// the middle of that by false position (Illinois), with a bisection now and then.
EventWatch::Piece EventWatch::locate(double h, double at_h, const Retake& retake) {
    constexpr double aim = 0.5;
    double a = 0.0, f_a = distance(t_, y_) - aim, b = h, f_b = at_h - aim;
    if (f_a <= -aim) return {0.0, true};
    const double resolution = 4.0 * std::numeric_limits<double>::epsilon();
    int side = 0;
    for (int k = 0; k < 200 && b - a > resolution * b; ++k) {
        // Just after an event the beginning is itself at the surface: no place to look near by.
        const bool left_behind = a == 0.0 && f_a < 2.0;
        if (left_behind && b < 1e-14 * h) return {0.0, true};
        double s = 0.5 * (a + b);
        if (!left_behind && k % 8 != 7) s = (a * f_b - b * f_a) / (f_b - f_a);
        if (!(s > a && s < b)) s = 0.5 * (a + b);
        const double f = distance(t_ + s, retake(s)) - aim;
        if (f > -aim && f <= aim) return {s, true};
        if (f > 0.0) {
            a = s;
            f_a = f;
            if (side == 1) f_b *= 0.5;
            side = 1;
        } else {
            b = s;
            f_b = std::max(f, -std::numeric_limits<double>::max());
            if (side == -1) f_a *= 0.5;
            side = -1;
        }
    }
    if (a > 0.0) retake(a);
    return {a, true};
}

std::size_t EventWatch::apply(double t, std::span<double> y) {
    const double least = distance(t, y);
    std::size_t happened = 0;
    for (const Event& event : events_) {
        if (event.distance(t, y) / event.tolerance > std::max(least, 1.0)) continue;
        happened += event.apply(t, y);
        count(t, event.name);
    }
    return happened;
}

void EventWatch::count(double t, const std::string& name) {
    at_last_t_ = t == last_t_ ? at_last_t_ + 1 : 0;
    last_t_ = t;
    if (!(t < window_end_)) {
        window_end_ = t + whole_;
        in_window_ = 0;
    }
    ++in_window_;
    if (at_last_t_ >= most_at_once)
        throw GuardStop(fmt::format("{}: {} events in a row at t = {:.6g}: time does not go on",
                                    name, at_last_t_, t));
    if (in_window_ > most_in_step)
        throw GuardStop(
            fmt::format("{}: more than {} events within one step at t = {:.6g}; a shorter step may "
                        "help, unless they follow each other ever faster",
                        name, most_in_step, t));
}

}  // namespace spam

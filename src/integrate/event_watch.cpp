// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_watch.hpp"

#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace spam {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t most_in_step = 10'000, most_at_once = 100;
constexpr double long_window = 64.0;  // steps
constexpr std::size_t most_in_long_window = 3200;
constexpr double smallest_piece = 1e-3;  // of a step: more would take too long
constexpr double aim = 0.5;              // of distances in units of the tolerance

/// A length and how far the distance there was from the aim.
struct Tried {
    double s, f;
};

double secant(const Tried& a, const Tried& b) { return (a.s * b.f - b.s * a.f) / (b.f - a.f); }

/// Where the parabola s(f) through three of them meets f = 0; not a number where two are the same.
double inverse_quadratic(const Tried& a, const Tried& b, const Tried& c) {
    return a.s * (b.f / (a.f - b.f)) * (c.f / (a.f - c.f)) +
           b.s * (a.f / (b.f - a.f)) * (c.f / (b.f - c.f)) +
           c.s * (a.f / (c.f - a.f)) * (b.f / (c.f - b.f));
}

}  // namespace

void EventWatch::begin(double t, std::span<const double> y) {
    t_ = t;
    y_ = y;
    for (const Event& event : events_)
        if (event.arm) event.arm(t, y);
}

/// Of the nearest event, in units of its tolerance.
double EventWatch::distance(double t, std::span<const double> y) const {
    double least = never;
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
    while (at_h == -never) {
        h *= 0.5;
        if (h < smallest_piece * whole_)
            throw GuardStop(fmt::format(
                "{} cannot be watched at t = {:.6g}: things move too fast for its distance "
                "or for the step",
                events_.front().name, t_));
        at_h = distance(t_ + h, retake(h));
        if (at_h > 0.0) return {h, false};
    }
    return locate(h, at_h, retake);
}

/// The distance is positive at 0 and is not at h. Looks for a length where it is in (0, 1], aiming at
/// the middle of that: inverse quadratic interpolation, false position (Illinois) where that leaves
/// the bracket, a bisection now and then.
EventWatch::Piece EventWatch::locate(double h, double at_h, const Retake& retake) {
    constexpr double resolution = 4.0 * std::numeric_limits<double>::epsilon();
    Tried a{0.0, distance(t_, y_) - aim}, b{h, at_h - aim}, before = a;
    if (a.f <= -aim) return {0.0, true};
    double stale_a = 1.0, stale_b = 1.0;
    for (int k = 0; k < 200 && b.s - a.s > resolution * b.s; ++k) {
        // Just after an event the beginning is itself at the surface and no place to look near by:
        // what is due next is approached from behind.
        const bool left_behind = a.f < 2.0;
        if (left_behind && b.s < 1e-14 * h) return {0.0, true};
        const auto inside = [&](double s) { return s > a.s && s < b.s; };
        double s = left_behind ? secant(b, before) : inverse_quadratic(a, b, before);
        if (!left_behind && !inside(s)) s = secant({a.s, stale_a * a.f}, {b.s, stale_b * b.f});
        if (k % 8 == 7 || !inside(s) || (left_behind && k == 0)) s = 0.5 * (a.s + b.s);
        const Tried now{s, distance(t_ + s, retake(s)) - aim};
        const bool near = now.f > -aim && now.f <= aim;
        if (near && (!left_behind || s >= 0.5 * b.s)) return {s, true};
        const bool early = now.f > -aim;
        stale_a = early ? 1.0 : 0.5 * stale_a;
        stale_b = early ? 0.5 * stale_b : 1.0;
        before = std::exchange(early ? a : b, now);
    }
    if (a.s > 0.0) retake(a.s);
    return {a.s, true};
}

std::size_t EventWatch::apply(double t, std::span<double> y) {
    // Due is what is within its tolerance, and what is nearest even where the step could be cut no closer.
    const double nearest = distance(t, y);
    std::size_t happened = 0;
    for (const Event& event : events_) {
        const double in_tolerances = event.distance(t, y) / event.tolerance;
        const bool due = in_tolerances <= std::max(nearest, 1.0);
        if (!due) continue;
        happened += event.apply(t, y);
        Parts& parts = Parts::here();
        count(t, parts.total(y.size() - parts.copies) + parts.copies, event.name);
    }
    return happened;
}

void EventWatch::remember(Archive& archive) {
    archive(whole_, window_end_, in_window_, long_window_end_, in_long_window_, last_t_,
            at_last_t_);
}

void EventWatch::count(double t, std::size_t entries, const std::string& name) {
    at_last_t_ = t == last_t_ ? at_last_t_ + 1 : 0;
    last_t_ = t;
    if (!(t < window_end_)) {
        window_end_ = t + whole_;
        in_window_ = 0;
    }
    ++in_window_;
    if (!(t < long_window_end_)) {
        long_window_end_ = t + long_window * whole_;
        in_long_window_ = 0;
    }
    if (++in_long_window_ > std::max(most_in_long_window, 2 * entries))
        throw GuardStop(
            fmt::format("{}: {} events within {:g} steps at t = {:.6g}; they repeat without end",
                        name, in_long_window_, long_window, t));
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/drift.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spam {
namespace {

/// What rounding may leave of forces that cancel: a few units in the last place.
constexpr double rounding = 1e-15;

/// Of the column of an invariant, less those of `given`, where there are such.
WatchedChange watched(const History& history, const std::string& invariant, const std::string& axis,
                      const std::vector<std::string>& given) {
    const auto column = [&](std::string name) {
        std::replace(name.begin(), name.end(), ' ', '_');
        return axis.empty() ? name : name + "_" + axis;
    };
    WatchedChange one{invariant, axis, {}, history.column(column(invariant))};
    for (const std::string& part : given) {
        if (!history.has(column(part))) continue;
        const std::vector<double> from_outside = history.column(column(part));
        for (std::size_t k = 0; k < one.change.size(); ++k) one.change[k] -= from_outside[k];
        one.given += (one.given.empty() ? "" : " and ") + part;
    }
    const double start = one.change.front();
    for (double& value : one.change) value -= start;
    return one;
}

/// Of all parts of an invariant.
double largest_change(const std::vector<WatchedChange>& all, const std::string& invariant) {
    double largest = 0.0;
    for (const WatchedChange& one : all) {
        if (one.invariant != invariant) continue;
        for (const double change : one.change) {
            if (!(std::abs(change) <= largest)) largest = std::abs(change);
            if (std::isnan(largest)) return largest;  // it stays: nothing is larger than NaN
        }
    }
    return largest;
}

/// `exchanged`: between neighbours during the run. A change of rounding * exchanged is at the limit. `swing`:
/// what is allowed in any case.
Drift drift_of(const char* name, Promise promise, double change, double size, double exchanged,
               double integrator_limit, double swing) {
    double limit = allowed_change(promise, integrator_limit);
    double scale = std::max(size, rounding / limit * exchanged);
    if (scale == 0.0) scale = 1.0;
    if (promise == Promise::integrator_error) limit = std::max(limit, swing / scale);
    // Beside what has overflowed every change would be nothing.
    const double part = !std::isfinite(scale) ? std::numeric_limits<double>::infinity()
                        : change == 0.0       ? 0.0
                                              : change / scale;
    return {name, promise, part, limit, scale};
}

}  // namespace

double allowed_change(Promise promise, double integrator_limit) {
    return promise == Promise::exact ? 1e-12 : integrator_limit;
}

void DriftScales::add(double t, const InvariantScales& now) {
    momentum = std::max(momentum, now.momentum);
    angular_momentum = std::max(angular_momentum, now.angular_momentum);
    if (begun_) {
        const double half = 0.5 * (t - t_);
        impulse += half * (before_.force + now.force);
        torque += half * (before_.torque + now.torque);
        work += half * (before_.power + now.power);
    }
    begun_ = true;
    t_ = t;
    before_ = now;
}

/// E begins with what it is off by at the start, so that twice that much is a change.
void DriftScales::add_swing(double dt, double by_square) {
    const double now = 2.0 * dt * dt * by_square;
    if (std::isfinite(now)) swing = std::max(swing, now);
}

void DriftScales::remember(Archive& archive) {
    archive(momentum, angular_momentum, impulse, torque, work, swing, t_, begun_);
    archive(before_.momentum, before_.angular_momentum, before_.force, before_.torque,
            before_.power);
}

std::string WatchedChange::name(bool with_axis) const {
    std::string words = invariant;
    if (with_axis && !axis.empty()) words += " " + axis;
    return given.empty() ? words : words + " less " + given;
}

std::vector<WatchedChange> watched_changes(const History& history) {
    if (history.rows().empty()) return {};
    std::vector<WatchedChange> all{watched(history, "mass", "", {})};
    for (const char* axis : {"x", "y", "z"})
        if (history.has(std::string("momentum_") + axis))
            all.push_back(watched(history, "momentum", axis, {"impulse"}));
    if (history.has("angular_momentum"))
        all.push_back(watched(history, "angular momentum", "", {"angular impulse"}));
    for (const char* axis : {"x", "y", "z"})
        if (history.has(std::string("angular_momentum_") + axis))
            all.push_back(watched(history, "angular momentum", axis, {"angular impulse"}));
    all.push_back(watched(history, "energy", "", {"work", "heat"}));
    return all;
}

std::vector<Drift> measure_drifts(const History& history, const Promises& promises,
                                  const DriftScales& scales, double integrator_limit) {
    if (history.rows().empty()) return {};
    const auto changes = watched_changes(history);
    std::vector<Drift> drifts;
    const auto add = [&](const char* name, Promise promise, double size, double exchanged,
                         double swing = 0.0) {
        drifts.push_back(drift_of(name, promise, largest_change(changes, name), size, exchanged,
                                  integrator_limit, swing));
    };
    add("mass", promises.mass, history.first("mass"), 0.0);
    add("momentum", promises.momentum, scales.momentum, scales.impulse);
    if (history.has("angular_momentum") || history.has("angular_momentum_z"))
        add("angular momentum", promises.angular_momentum, scales.angular_momentum, scales.torque);
    add("energy", promises.energy,
        std::max(std::abs(history.first("energy")), history.largest("kinetic")), scales.work,
        scales.swing);
    return drifts;
}

}  // namespace spam

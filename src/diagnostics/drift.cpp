// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/drift.hpp>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// What rounding may leave of forces that cancel: a few units in the last place.
constexpr double rounding = 1e-15;

/// Largest change of a column over the run, less the columns of what externals have given (where there
/// are such).
double largest_change(const History& history, const std::string& name,
                      const std::vector<std::string>& given) {
    if (std::none_of(given.begin(), given.end(),
                     [&](const std::string& column) { return history.has(column); }))
        return history.largest_change(name);
    std::vector<double> balance = history.column(name);
    for (const std::string& column : given) {
        const std::vector<double> from_outside = history.column(column);
        for (std::size_t k = 0; k < balance.size(); ++k) balance[k] -= from_outside[k];
    }
    double change = 0.0;
    for (const double b : balance) {
        const double here = std::abs(b - balance.front());
        if (!(here <= change)) change = here;  // NaN stays: std::max would drop it
        if (std::isnan(change)) break;
    }
    return change;
}

/// Of a quantity stored as `name` or as `name`_x, _y, _z, and of what is given to it.
double largest_vector_change(const History& history, const std::string& name,
                             const std::string& given) {
    double change = 0.0;
    for (const char* axis : {"", "_x", "_y", "_z"}) {
        if (!history.has(name + axis)) continue;
        const double here = largest_change(history, name + axis, {given + axis});
        if (!(here <= change)) change = here;  // NaN stays: std::max would drop it
        if (std::isnan(change)) break;
    }
    return change;
}

/// `exchanged`: between neighbours during the run. A change of rounding * exchanged is at the limit.
Drift drift_of(const char* name, Promise promise, double change, double size, double exchanged,
               double integrator_limit) {
    const double limit = allowed_change(promise, integrator_limit);
    double scale = std::max(size, rounding / limit * exchanged);
    if (!(scale > 0.0)) scale = 1.0;
    return {name, promise, change == 0.0 ? 0.0 : change / scale, limit, scale};
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

void DriftScales::remember(Archive& archive) {
    archive(momentum, angular_momentum, impulse, torque, work, t_, begun_);
    archive(before_.momentum, before_.angular_momentum, before_.force, before_.torque,
            before_.power);
}

std::vector<Drift> measure_drifts(const History& history, const Promises& promises,
                                  const DriftScales& scales, double integrator_limit) {
    if (history.rows().empty()) return {};
    std::vector<Drift> drifts;
    const auto add = [&](const char* name, Promise promise, double change, double size,
                         double exchanged) {
        drifts.push_back(drift_of(name, promise, change, size, exchanged, integrator_limit));
    };
    add("mass", promises.mass, history.largest_change("mass"), history.first("mass"), 0.0);
    add("momentum", promises.momentum, largest_vector_change(history, "momentum", "impulse"),
        scales.momentum, scales.impulse);
    if (history.has("angular_momentum") || history.has("angular_momentum_z"))
        add("angular momentum", promises.angular_momentum,
            largest_vector_change(history, "angular_momentum", "angular_impulse"),
            scales.angular_momentum, scales.torque);
    add("energy", promises.energy, largest_change(history, "energy", {"work", "heat"}),
        std::max(std::abs(history.first("energy")), history.largest("kinetic")), scales.work);
    return drifts;
}

}  // namespace spam

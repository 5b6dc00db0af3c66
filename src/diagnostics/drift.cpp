// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/diagnostics/drift.hpp>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// Largest change of a quantity stored as `name` or as `name`_x, _y, _z.
double largest_vector_change(const History& history, const std::string& name) {
    double change = 0.0;
    for (const char* axis : {"", "_x", "_y", "_z"}) {
        if (!history.has(name + axis)) continue;
        const double here = history.largest_change(name + axis);
        if (!(here <= change)) change = here;  // NaN stays: std::max would drop it
        if (std::isnan(change)) break;
    }
    return change;
}

}  // namespace

double allowed_change(Promise promise, double integrator_limit) {
    return promise == Promise::exact ? 1e-12 : integrator_limit;
}

std::vector<Drift> measure_drifts(const History& history, const Promises& promises,
                                  double momentum_scale, double angular_momentum_scale,
                                  double integrator_limit) {
    const auto limit = [&](Promise p) { return allowed_change(p, integrator_limit); };
    const auto relative = [](double change, double scale) {
        return change == 0.0 ? 0.0 : change / (scale > 0.0 ? scale : 1.0);
    };
    const double energy_scale =
        std::max(std::abs(history.first("energy")), history.largest("kinetic"));
    std::vector<Drift> drifts{
        {"mass", promises.mass, relative(history.largest_change("mass"), history.first("mass")),
         limit(promises.mass)},
        {"momentum", promises.momentum,
         relative(largest_vector_change(history, "momentum"), momentum_scale),
         limit(promises.momentum)}};
    if (history.has("angular_momentum") || history.has("angular_momentum_z"))
        drifts.push_back(
            {"angular momentum", promises.angular_momentum,
             relative(largest_vector_change(history, "angular_momentum"), angular_momentum_scale),
             limit(promises.angular_momentum)});
    drifts.push_back({"energy", promises.energy,
                      relative(history.largest_change("energy"), energy_scale),
                      limit(promises.energy)});
    return drifts;
}

}  // namespace spam

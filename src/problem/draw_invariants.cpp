// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_invariants.hpp"

#include <spam/diagnostics/drift.hpp>
#include <spam/picture/draw.hpp>

#include <algorithm>

namespace spam {

bool draw_invariants(const RunFolder& folder, const History& history, std::string title,
                     const Units& units, int dim) {
    std::replace(title.begin(), title.end(), '_', ' ');
    const auto t = history.column("t");
    const std::string time = units.axis("t", "t", dim);
    CurvePanel energy{"energies", time, units.axis("energy", "m l^2/t^2", dim), false, {}};
    for (const char* name : {"kinetic", "internal", "energy"})
        energy.curves.push_back({name, t, history.column(name)});
    CurvePanel drift{"what must stay constant: change since t = 0", time, "|change|", true, {}};
    if (units.named()) drift.y_label += ", units as in statistics.json";
    for (WatchedChange& one : watched_changes(history)) {
        const bool moved = std::any_of(one.change.begin(), one.change.end(),
                                       [](double change) { return change != 0.0; });
        if (one.invariant != "mass" || moved)  // nearly always none at all
            drift.curves.push_back({std::move(one.name), t, std::move(one.change)});
    }
    return draw_curves(folder, "invariants", title, {energy, drift});
}

}  // namespace spam

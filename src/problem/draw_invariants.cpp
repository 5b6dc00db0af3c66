// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_invariants.hpp"

#include <spam/diagnostics/drift.hpp>
#include <spam/picture/draw.hpp>

#include <algorithm>

namespace spam {
namespace {

const char* made_of(const std::string& invariant) {
    return invariant == "mass"               ? "m"
           : invariant == "momentum"         ? "m l/t"
           : invariant == "angular momentum" ? "m l^2/t"
                                             : "m l^2/t^2";
}

}  // namespace

bool draw_invariants(const RunFolder& folder, const History& history, std::string title,
                     const UnitNames& units, int dim) {
    std::replace(title.begin(), title.end(), '_', ' ');
    const auto t = history.column("t");
    const std::string time = units.reduced.empty() ? units.axis("t", "t", dim) : "t, reduced units";
    CurvePanel energy{"energies", time, units.axis("energy", "m l^2/t^2", dim), false, {}};
    for (const char* name : {"kinetic", "internal", "energy"})
        energy.curves.push_back({name, t, history.column(name)});
    std::vector<CurvePanel> panels{std::move(energy)};
    for (WatchedChange& one : watched_changes(history)) {  // components of a vector share a frame
        const bool moved = std::any_of(one.change.begin(), one.change.end(),
                                       [](double change) { return change != 0.0; });
        if (one.invariant == "mass" && !moved) continue;  // nearly always
        const std::string what = one.name(false);
        if (panels.back().title != what)
            panels.push_back({what,
                              time,
                              units.axis("|change since t = 0|", made_of(one.invariant), dim),
                              true,
                              {}});
        panels.back().curves.push_back({std::move(one.axis), t, std::move(one.change)});
    }
    return draw_curves(folder, "invariants", title, panels, 2);
}

}  // namespace spam

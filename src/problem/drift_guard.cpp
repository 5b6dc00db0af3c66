// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/problem/drift_guard.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

std::string_view to_string(DriftAction action) {
    return action == DriftAction::off ? "off" : action == DriftAction::warn ? "warn" : "stop";
}

std::optional<double> DriftLimits::limit_of(const Drift& drift) const {
    const std::optional<double> own = drift.name == "mass"       ? std::nullopt
                                      : drift.name == "momentum" ? momentum
                                      : drift.name == "energy"   ? energy
                                                                 : angular_momentum;
    if (own) return own;
    return drift.promise == Promise::not_kept ? std::nullopt : std::optional(drift.limit);
}

std::string DriftLimits::describe(const std::vector<Drift>& drifts) const {
    if (action == DriftAction::off) return "off";
    std::string text;
    for (const Drift& drift : drifts)
        if (const auto limit = limit_of(drift))
            text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", drift.name, *limit);
    return fmt::format("{} beyond {}", action == DriftAction::warn ? "warns" : "stops", text);
}

std::string DriftGuard::Exceeded::describe() const {
    return fmt::format("{} changed by {:.3g}, more than the limit {:.3g}", name, change, limit);
}

std::vector<DriftGuard::Exceeded> DriftGuard::newly_exceeded(const std::vector<Drift>& drifts) {
    std::vector<Exceeded> beyond;
    for (const Drift& drift : drifts) {
        const auto limit = limits_.limit_of(drift);
        if (!limit || drift.change <= *limit) continue;
        const bool known = std::find(known_.begin(), known_.end(), drift.name) != known_.end();
        if (known && limits_.action == DriftAction::warn) continue;  // a restart is stopped again
        if (!known) known_.push_back(drift.name);
        beyond.push_back({drift.name, drift.change, *limit});
    }
    return beyond;
}

}  // namespace spam

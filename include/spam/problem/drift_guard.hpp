// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/archive.hpp>
#include <spam/diagnostics/drift.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// What a run does when an invariant leaves its limit.
enum class DriftAction { off, warn, stop };
std::string_view to_string(DriftAction action);

/// Limits of relative changes, on the scales of measure_drifts(). Unset: what the scheme promises;
/// what it does not promise is watched only where a limit is set. Particles keep their masses: there is
/// no limit to choose.
struct DriftLimits {
    DriftAction action = DriftAction::off;
    std::optional<double> momentum{}, angular_momentum{}, energy{};

    std::optional<double> limit_of(const Drift& drift) const;
    /// "warns beyond momentum 1e-12, energy 1e-06", for the banner.
    std::string describe(const std::vector<Drift>& drifts) const;
};

/// Watches the drifts of a run, row by row.
class DriftGuard {
  public:
    explicit DriftGuard(const DriftLimits& limits) : limits_(limits) {}

    struct Exceeded {
        std::string name;
        double change, limit;
        std::string describe() const;  ///< "energy changed by 1.2e-3, more than the limit 1e-6"
    };
    /// What is beyond its limit now and was not before. A change that is not a number is beyond all.
    std::vector<Exceeded> newly_exceeded(const std::vector<Drift>& drifts);

    DriftAction action() const { return limits_.action; }
    void remember(Archive& archive) { archive(known_); }

  private:
    DriftLimits limits_;
    std::vector<std::string> known_;  ///< invariants beyond their limits
};

}  // namespace spam

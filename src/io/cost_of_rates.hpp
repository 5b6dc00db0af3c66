// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace spam {

/// What one right-hand side of a run has cost on the mean.
struct CostOfRates {
    double seconds = 0.0, pairs = 0.0;
};

/// Of the run that has left its statistics.json in that folder; zeros where there is none, as behind a run that was
/// killed, or where it is damaged: nothing but what a run reports of itself depends on it.
CostOfRates cost_of_rates(const std::filesystem::path& folder);

}  // namespace spam

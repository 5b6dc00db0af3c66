// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/unit_names.hpp>
#include <spam/diagnostics/history.hpp>
#include <spam/io/run_folder.hpp>

#include <string>

namespace spam {

/// Draws FOLDER/invariants.png: the energies, and the changes that the table of drifts judges. As draw_curves().
bool draw_invariants(const RunFolder& folder, const History& history, std::string title,
                     const UnitNames& units, int dim);

}  // namespace spam

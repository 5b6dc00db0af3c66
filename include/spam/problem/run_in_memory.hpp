// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/integrate/integrator.hpp>
#include <spam/problem/plan.hpp>

namespace spam {

/// Runs a case without files, pictures or progress: for studies of many small runs. Rows are recorded,
/// `on_snapshot` is called. A guard that stops the run is named in record.statistics.stopped. Several
/// may run at once, each with a model of its own, in threads of the caller.
template <int Dim>
RunRecord run_in_memory(Case<Dim> one, const IntegratorOptions& integrator);

}  // namespace spam

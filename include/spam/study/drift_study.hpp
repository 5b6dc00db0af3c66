// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/problem/session.hpp>
#include <spam/study/study_method.hpp>
#include <spam/study/trial.hpp>

#include <string>
#include <vector>

namespace spam {

/// A study of integrators: drifts of momentum, angular momentum and energy in long runs, every method
/// at the same cost, and whether they grow for ever.
///
/// cost    right-hand sides per time: `calls-per-time`. Methods take fixed steps of that cost; those
///         that cannot, steps for the tolerance that costs as much in the first tenth of the time
/// drift   change since t = 0 over the invariant's size (conserved_scales()), at 601 times
/// growth  fit_growth(): exponent of the envelope between a tenth of the time and its end; bounded
///         below 0.25, a random walk below 0.75, secular above; round-off below 1e-13
///
/// Leaves invariant_drift.csv (a row a run; a study that was stopped goes on), the drifts of every run
/// in drifts/, a picture an invariant, and checks in result.json: momentum to round-off where that is promised,
/// and for methods that advance positions and velocities in turn an energy that stays bounded where it
/// derives from a smooth potential.
class DriftStudy {
  public:
    /// methods, calls-per-time, jobs.
    void add_options(Options& options);

    /// Nothing is written before all systems and methods are known to be sound; methods that cannot
    /// integrate a system are left out there, and that is said.
    template <int Dim>
    void run(Session& session, const std::vector<Trial<Dim>>& trials);

    /// Methods used where --methods is not given.
    std::vector<std::string> standard_methods = methods_of_every_kind();

  private:
    std::string methods_;
    double calls_per_time_ = 20.0;
    int jobs_ = 1;
};

}  // namespace spam

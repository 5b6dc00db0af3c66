// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/problem/session.hpp>
#include <spam/study/study_method.hpp>
#include <spam/study/trial.hpp>

#include <string>
#include <vector>

namespace spam {

enum class StepKind { both, fixed, adaptive };
std::string_view to_string(StepKind);

/// A study of integrators: error against work. Every method integrates every system with a ladder of
/// fixed steps and of tolerances; the errors at the end of the time are those against a reference.
///
/// reference   arkode:FEHLBERG_13_7_8, with the tolerance 1e-13, or with as many fixed steps as make
///             twice `calls` right-hand sides (better where dy/dt is smooth). Of each there is a twin
///             by arkode:VERNER_8_5_6; the pair that differs less is used, and its difference is the
///             floor: errors below it are marked unknown
/// error       of a field: root mean square over its entries, and the largest, both over the field's
///             scale (positions: the spacing; others: the larger of its root mean squares at the start
///             and at the end). `error` is the largest root mean square of all fields
/// work        right-hand sides, and seconds: processor time of the run's own thread, the least of up
///             to five runs (one where that takes 0.05 s), observers off, the model made before. Other
///             jobs disturb it through shared caches only; --jobs 1 leaves that out as well
/// steps       t_end/n with ever larger n: from 1/256 of `calls` right-hand sides to `calls`, in
///             factors of sqrt 2, for all methods alike. Tolerances 1e-2, 1e-3, ... `tightest`,
///             relative and (times the scale of a field) absolute. A run that needs half as many
///             again as `calls` is given up
/// order       fit_convergence() of each method's fixed steps; claimed within 0.1 of the nominal one
///             where the system is smooth and the nominal order at most 6: above, hardly any steps are
///             left between those too large and round-off
///
/// A problem of one's own:
///     WorkPrecision study;
///     study.standard_methods = {"rk4", "arkode:DORMAND_PRINCE_7_4_5"};
///     study.add_options(problem.options());
///     return problem.main(argc, argv, [&](Session& session) {
///         study.run<1>(session, {{"chain", "Chain of springs", chain, 10.0}});
///     });
/// where chain() makes a Start<1>: a model and the state it starts from (tests/problem/own_study.cpp).
///
/// Leaves integrator_accuracy.csv (a row a run; a study that was stopped goes on), orders.csv, a
/// picture a system, and checks in result.json.
class WorkPrecision {
  public:
    /// methods, steps, calls, tightest, jobs.
    void add_options(Options& options);

    /// Nothing is written before all systems and methods are known to be sound. Where a method cannot
    /// integrate a system (leapfrog, say, what is not separable) it is left out there, and that is said.
    template <int Dim>
    void run(Session& session, const std::vector<Trial<Dim>>& trials);

    /// Methods used where --methods is not given.
    std::vector<std::string> standard_methods = methods_of_every_kind();

  private:
    std::string methods_;
    StepKind steps_ = StepKind::both;
    int calls_ = 20'000;
    double tightest_ = 1e-12;
    int jobs_ = 1;
};

}  // namespace spam

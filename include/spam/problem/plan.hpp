// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/drift.hpp>
#include <spam/io/results.hpp>
#include <spam/problem/drift_guard.hpp>
#include <spam/problem/observer.hpp>
#include <spam/problem/rezoning.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

namespace spam {

/// How far a run goes and what is recorded on the way. Zero intervals are filled in by the session:
/// rows 240, snapshots 12 over the run, checkpoints with snapshots but no more than 12, unless
/// --output-every, --snapshot-every or --checkpoint-every say otherwise.
template <int Dim>
struct Plan {
    /// Time at which the run ends.
    double t_end = 0.0;
    /// Time between rows of invariants.csv.
    double output_every = 0.0;
    /// Time between configurations.
    double snapshot_every = 0.0;
    /// Time between checkpoints.
    double checkpoint_every = 0.0;
    /// Of rk4, where --dt is not given, for a case among others that needs a step of its own; else
    /// Session::prefer_step(), which case.toml tells of.
    std::optional<double> step{};
    /// The method, where --integrator is not given, of a case among others that another one than theirs suits; with
    /// `step`.
    std::optional<std::string> method{};
    /// t_end stays what it is: --t-end is meant for other cases of the session.
    bool own_end = false;
    /// What watches the run, in the order of the calls.
    std::vector<Observer<Dim>> observers{};
    /// Checked after every row. A Session replaces it by --guard (default: warn); off in run_in_memory() unless given.
    DriftLimits guard{};

    /// How the number of particles changes on the way; nothing where it stays.
    std::optional<Rezoning<Dim>> rezoning{};

    /// Adds an observer.
    void observe(Observer<Dim> observer) { observers.push_back(std::move(observer)); }
    /// Lets the number of particles change, and records what that does (Rezoning::observer).
    void rezone(Rezoning<Dim> how) {
        observe(how.observer());
        rezoning = std::move(how);
    }
    /// Adds columns to invariants.csv.
    void record(std::vector<Column<Dim>> columns) { observe({.columns = std::move(columns)}); }
    /// Whether an observer may change the state or the bodies.
    bool may_change() const {
        return std::any_of(observers.begin(), observers.end(),
                           [](const auto& one) { return one.revise != nullptr; });
    }
};

/// What a run left behind.
struct RunRecord {
    /// Of the case; empty where there is one only.
    std::string label;
    /// The rows of invariants.csv.
    History history{{}};
    /// What it cost.
    RunStatistics statistics;
    /// What became of every invariant.
    std::vector<Drift> drifts;
    std::vector<std::pair<double, Remark>> remarks;  ///< by time
    std::vector<double> y;                           ///< the last accepted state
    bool complete = false;                           ///< reached t_end, or enough
};

/// One run to do: a model, where it starts, and a name for its folder when there are several. The model
/// is shared with what looks at it afterwards.
template <int Dim>
struct Case {
    /// What moves.
    std::shared_ptr<Model<Dim>> model;
    /// Where it starts, model->layout().size() numbers; empty where `start` says it.
    std::vector<double> y0;
    /// How far it goes, and what is recorded.
    Plan<Dim> plan;
    /// Name of its folder; words joined by _.
    std::string label{};
    /// y0 where it follows from how the case before ended; y0 is then empty, and the case is begun only
    /// where the one before is complete. Asked again when a run is gone on with: the same record must give
    /// the same y0.
    std::function<std::vector<double>(const RunRecord& before)> start{};
};

/// A model that the caller keeps until the run has ended, for a Case.
template <int Dim>
std::shared_ptr<Model<Dim>> kept_elsewhere(Model<Dim>& model) {
    return {std::shared_ptr<void>{}, &model};
}

}  // namespace spam

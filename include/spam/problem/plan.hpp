// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/drift.hpp>
#include <spam/io/results.hpp>
#include <spam/problem/drift_guard.hpp>
#include <spam/rhs/model.hpp>

#include <functional>

namespace spam {

/// A further column of invariants.csv: its name and how to measure it.
template <int Dim>
struct Column {
    std::string name;
    std::function<double(const Model<Dim>& model, std::span<const double> y)> measure;
};

/// How far a run goes and what is recorded on the way. Zero intervals are filled in by the session:
/// rows 240, snapshots 12 over the run, checkpoints with snapshots but no more than 12, unless
/// --output-every, --snapshot-every or --checkpoint-every say otherwise.
template <int Dim>
struct Plan {
    double t_end = 0.0;
    double output_every = 0.0;
    double snapshot_every = 0.0;
    double checkpoint_every = 0.0;
    std::vector<Column<Dim>> columns{};
    /// Looked at after every row. Off unless the session's options say otherwise.
    DriftLimits guard{};
    /// Called with every snapshot; may be empty.
    std::function<void(double t, const Model<Dim>& model, std::span<const double> y)> on_snapshot{};
    /// What on_snapshot and revise gather outside the model, for checkpoints. May be empty.
    std::function<void(Archive&)> memory{};
    /// After every row: may change the state or the model's bodies, and returns whether it did. May be
    /// empty.
    std::function<bool(double t, Model<Dim>& model, std::span<double> y)> revise{};
    /// After every row: whether the run has shown what it was for. It then ends, complete. May be empty.
    std::function<bool(const History& history)> enough{};
};

/// One run to do: a model, where it starts, and a name for its folder when there are several.
template <int Dim>
struct Case {
    Model<Dim>& model;
    std::vector<double> y0;
    Plan<Dim> plan;
    std::string label{};
};

/// What a run left behind.
struct RunRecord {
    std::string label;
    History history{{}};
    RunStatistics statistics;
    std::vector<Drift> drifts;
    std::vector<std::pair<double, Remark>> remarks;  ///< by time
    std::vector<double> y;                           ///< the last accepted state
    bool complete = false;                           ///< reached t_end, or enough
};

/// Shape error against the reference configuration, column `shape_error`.
template <int Dim>
Column<Dim> shape_error_column();
/// Distance of the closest two particles, column `closest_pair`.
template <int Dim>
Column<Dim> closest_pair_column();
/// Torques between particles and their shares (diagnostics/pair_torques.hpp), for models of smooth
/// particles: `pair_torques_negative`, `..._positive` (how many), `..._negative_sum`,
/// `..._positive_sum`, `..._factor` (R = sqrt(P/M)); the same of `particle_torques`.
std::vector<Column<2>> pair_torque_columns();

}  // namespace spam

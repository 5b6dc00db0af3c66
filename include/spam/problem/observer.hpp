// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/archive.hpp>
#include <spam/diagnostics/history.hpp>
#include <spam/rhs/model.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace spam {

/// A further column of invariants.csv: its name and how to measure it.
template <int Dim>
struct Column {
    /// Of the column: words joined by _. One that invariants.csv has already is refused.
    std::string name;
    /// Called at every row with the state there; what it returns should be finite.
    std::function<double(const Model<Dim>& model, std::span<const double> y)> measure;
};

/// Something that watches a run, and may take part in it. Every member may be left out; a run calls those
/// of its observers in the order in which they were added. What they refer to must outlive the run.
template <int Dim>
struct Observer {
    /// y, model.layout().size() numbers.
    using State = std::span<const double>;
    /// Measured at every row of invariants.csv.
    std::vector<Column<Dim>> columns{};
    /// At every row, the first one included, before the columns are measured.
    std::function<void(double t, const Model<Dim>& model, State y)> on_row{};
    /// At every snapshot.
    std::function<void(double t, const Model<Dim>& model, State y)> on_snapshot{};
    /// After every row but the first: may change the state or the model's bodies, and returns whether it
    /// did; the integrator then begins anew.
    std::function<bool(double t, Model<Dim>& model, std::span<double> y)> revise{};
    /// After every row: whether the run has shown what it was for. It then ends, complete.
    std::function<bool(const History& history)> enough{};
    /// Writes or reads what the others gather outside the model: part of every checkpoint.
    std::function<void(Archive&)> memory{};
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

// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of the study share: its table.
#pragma once

#include "reference.hpp"
#include <spam/diagnostics/convergence.hpp>
#include <spam/study/work_precision.hpp>

#include <string>
#include <vector>

namespace spam::work_precision {

const std::vector<std::string>& columns();
const std::string& cell(const StudyTable::Row& row, std::string_view column);
/// NaN for an empty cell.
double number(const StudyTable::Row& row, std::string_view column);

/// The cells of a row after its name: one run, compared. Nothing where a signal interrupted it.
template <int Dim>
std::optional<StudyTable::Row> measure(const Trial<Dim>& trial, Reference<Dim>& reference,
                                       const StudyMethod& method, const IntegratorOptions& options,
                                       std::size_t most_calls);

/// One run of a curve as numbers; NaN where it did not reach the end.
struct Sample {
    double dt, calls, seconds, error;
    bool known;  ///< error above the floor
};

/// A method with one kind of steps on one system, most work last.
struct Branch {
    std::size_t trial, method;
    bool fixed;
    std::vector<StudyTask> tasks{};
    std::vector<Sample> samples{};
};

/// Work at which a branch reaches an error: between two of its samples, linear in the logarithms.
/// Infinite where it does not.
double work_for(const Branch& branch, double error, double Sample::*work);

/// What the study needs to know of a system when it reports.
struct TrialWords {
    std::string name, title, rough;
    std::size_t particles;
    double t_end;
    double floor;
};

/// Orders, cheapest methods, checks and pictures.
void report(Session& session, const std::vector<TrialWords>& trials,
            const std::vector<StudyMethod>& methods, const std::vector<Branch>& branches);

}  // namespace spam::work_precision

// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of the study share: its table.
#pragma once

#include <spam/diagnostics/convergence.hpp>
#include <spam/problem/work_precision.hpp>

#include <string>
#include <vector>

namespace spam::work_precision {

/// One curve: a method with one kind of steps on one system.
struct Branch {
    std::size_t trial, method;
    bool fixed;
};

/// A row of the table as numbers; NaN where the run did not reach the end.
struct Sample {
    double dt, calls, seconds, error;
    bool known;  ///< error above the floor
};

const std::vector<std::string>& columns();
std::size_t column(std::string_view name);

/// Points of a curve, most work last.
struct Measured {
    Branch curve;
    std::vector<Sample> points{};
};

/// Work at which a curve reaches an error: between two of its points, linear in the logarithms.
/// Infinite where it does not.
double work_for(const Measured& curve, double error, double Sample::*work);

/// What the study needs to know of a system when it reports.
struct TrialWords {
    std::string name, title, rough;
    double floor;
    std::size_t particles;
    double t_end;
};

/// Orders, cheapest methods, checks and pictures.
void report(Session& session, const std::vector<TrialWords>& trials,
            const std::vector<StudyMethod>& methods, const std::vector<Measured>& curves);

}  // namespace spam::work_precision

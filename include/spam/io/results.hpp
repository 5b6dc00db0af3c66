// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/unit_names.hpp>
#include <spam/diagnostics/drift.hpp>
#include <spam/io/run_folder.hpp>

#include <optional>
#include <string>
#include <vector>

namespace spam {

/// One thing a problem measured, as written to result.json. Where `expected` is set, |value -
/// expected| <= tolerance must hold; otherwise nothing is claimed. What is not a finite number never
/// holds: a problem leaves out what its case does not have.
struct Check {
    /// As in result.json: words joined by _.
    std::string name;
    /// What was measured, in the units of the run.
    double value;
    /// What it must be; unset where nothing is claimed.
    std::optional<double> expected;
    /// Largest |value - expected| that holds.
    double tolerance = 0.0;
    std::string source;  ///< where the expectation comes from, e.g. "[HHM04] VIII"

    /// Whether |value - expected| <= tolerance, or nothing is claimed of a finite value.
    bool holds() const;
};

/// What a run cost, as written to statistics.json.
struct RunStatistics {
    /// Name of the problem.
    std::string problem;
    /// Of its numbers.
    UnitNames units{};
    int dim = 2;  ///< of the particles
    /// N of the first run.
    std::size_t particles = 0;
    /// Time reached.
    double t_end = 0.0;
    /// Accepted.
    std::size_t steps = 0;
    /// Tried and given up, their error being too large.
    std::size_t rejected_steps = 0;
    /// Right-hand sides evaluated.
    std::size_t rhs_evaluations = 0;
    std::size_t events = 0;  ///< between steps: reflections of pairs
    /// Of the clock, output included.
    double wall_seconds = 0.0;
    std::size_t pair_interactions = 0;  ///< undirected pairs summed over, all right-hand sides
    /// What kept adaptive steps short; nothing where steps were fixed.
    struct Limit {
        /// A field of y.
        std::string field;
        std::size_t steps;   ///< that it limited
        double error_share;  ///< its part of their errors' sum of squares, summed over all steps
    };
    /// By field, of adaptive steps.
    std::vector<Limit> limited_by;
    /// Of a run on several processes: how often each has exchanged something with the others, what all of them have
    /// sent, and the longest time that one has spent there, waiting included.
    struct Ranks {
        std::size_t count = 1, exchanges = 0, bytes = 0;
        double seconds = 0.0;
    };
    Ranks ranks{};                  ///< since the start or the restart
    std::string stopped;            ///< empty for a complete run
    std::vector<Drift> invariants;  ///< of one run; a sum of runs has none

    /// Another run of the same study.
    void add(const RunStatistics& other);
    /// "stress 143 steps (82 % of the error), ..."; empty where steps were fixed.
    std::string limits_in_words() const;
};

void write_results(const RunFolder& folder, const std::vector<Check>& checks);
void write_statistics(const RunFolder& folder, const RunStatistics& statistics);

/// "0.1.0", and with the commit the program was built from where known.
std::string version();

}  // namespace spam

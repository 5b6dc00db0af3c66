// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of the study share: its table and the files of drifts.
#pragma once

#include <spam/diagnostics/convergence.hpp>
#include <spam/study/drift_study.hpp>

#include <array>
#include <string>
#include <vector>

namespace spam::drift_study {

inline constexpr std::array<std::string_view, 3> invariants{"momentum", "angular_momentum",
                                                            "energy"};
inline constexpr double round_off = 1e-13;

const std::vector<std::string>& columns();
const std::string& cell(const StudyTable::Row& row, std::string_view column);

/// Changes of the invariants with time, over their sizes.
struct Drifts {
    std::vector<double> t{};
    std::array<std::vector<double>, invariants.size()> change{};
};
std::string as_csv(const Drifts& drifts);
/// Of a file that as_csv() was written to. Throws OutputError where it is not one.
Drifts read_drifts(const std::filesystem::path& file);

/// One method on one system.
struct LongRun {
    std::size_t trial, method;
    IntegratorOptions options;
    StudyTask task{};
    std::string file() const;  ///< of its drifts
};

/// The cells of a row after its name; the drifts into the folder. Nothing where a signal interrupted it.
template <int Dim>
std::optional<StudyTable::Row> measure(const Trial<Dim>& trial, const LongRun& run,
                                       const RunFolder& folder);

/// What the study needs to know of a system when it reports.
struct TrialWords {
    std::string name, title;
    double t_end;
    Promises promises;
    bool smooth;
};

/// Table in words, checks and the picture.
void report(Session& session, const std::vector<TrialWords>& trials,
            const std::vector<StudyMethod>& methods, const std::vector<LongRun>& runs,
            const std::vector<StudyTable::Row>& rows, double calls_per_time);

}  // namespace spam::drift_study

// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift_study.hpp"
#include <spam/core/error.hpp>
#include <spam/io/csv.hpp>
#include <spam/io/text_file.hpp>
#include <spam/problem/run_in_memory.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam::drift_study {
namespace {

constexpr double rows_of_run = 601.0;  // a prime: in step with no oscillation

/// Norm of the change of what is stored as `name`, or as `name`_x, _y, _z.
std::vector<double> change_of(const History& history, const std::string& name) {
    std::vector<double> squares(history.rows().size(), 0.0);
    for (const char* axis : {"", "_x", "_y", "_z"}) {
        if (!history.has(name + axis)) continue;
        const auto values = history.column(name + axis);
        for (std::size_t k = 0; k < values.size(); ++k)
            squares[k] += std::pow(values[k] - values.front(), 2);
    }
    for (double& square : squares) square = std::sqrt(square);
    return squares;
}

template <int Dim>
Drifts drifts_of(const Start<Dim>& start, const History& history) {
    const auto scales = conserved_scales<Dim>(*start.model, start.y0, history.largest("kinetic"));
    const std::array<double, invariants.size()> scale{scales.momentum, scales.angular_momentum,
                                                      scales.energy};
    Drifts drifts{history.column("t"), {}};
    for (std::size_t k = 0; k < invariants.size(); ++k) {
        drifts.change[k] = change_of(history, std::string(invariants[k]));
        for (double& change : drifts.change[k])
            if (change > 0.0) change /= scale[k];
    }
    return drifts;
}

}  // namespace

const std::vector<std::string>& columns() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all{"case",      "problem",         "method",        "dt",
                                     "tolerance", "rhs_evaluations", "calls_per_time"};
        for (const auto name : invariants)
            for (const char* what : {"_drift", "_exponent", "_growth"})
                all.push_back(std::string(name) + what);
        all.insert(all.end(), {"end", "seconds"});
        return all;
    }();
    return names;
}

const std::string& cell(const StudyTable::Row& row, std::string_view column) {
    return cell_of(row, columns(), column);
}

std::string as_csv(const Drifts& drifts) {
    std::string text = fmt::format("t,{}\n", fmt::join(invariants, ","));
    for (std::size_t k = 0; k < drifts.t.size(); ++k) {
        text += fmt::format("{:.10g}", drifts.t[k]);
        for (const auto& change : drifts.change)  // none where a run was stopped
            text += std::isfinite(change[k]) ? fmt::format(",{:.10g}", change[k]) : ",";
        text += '\n';
    }
    return text;
}

Drifts read_drifts(const std::filesystem::path& file) {
    CsvReader rows(text_file(file.string(), "out", "a table of drifts"), file.string(),
                   {.option = "out", .remedy = "begin anew with --force, or another --out"});
    Drifts drifts;
    if (rows.next()) {
        if (rows.cells().size() != 1 + invariants.size())
            rows.refuse(fmt::format("has {} cells in place of {}", rows.cells().size(),
                                    1 + invariants.size()));
        rows.keep_as_header();
    }
    while (rows.next()) {
        drifts.t.push_back(rows.number(0));
        for (std::size_t k = 0; k < invariants.size(); ++k)
            drifts.change[k].push_back(rows.number(k + 1));
    }
    if (drifts.t.size() < 3) throw OutputError(fmt::format("cannot read '{}' back", file.string()));
    return drifts;
}

std::string LongRun::file() const {
    std::string name = task.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == ':'; }, '_');
    return name + ".csv";
}

template <int Dim>
std::optional<StudyTable::Row> measure(const Trial<Dim>& trial, const LongRun& run,
                                       const RunFolder& folder) {
    Start<Dim> start = trial.start();
    Plan<Dim> plan;
    plan.t_end = plan.snapshot_every = trial.t_end;
    plan.output_every = trial.t_end / rows_of_run;
    const RunRecord record =
        run_in_memory<Dim>({start.model, start.y0, std::move(plan)}, run.options);
    const RunStatistics& s = record.statistics;
    if (s.stopped.starts_with("signal")) return {};
    const Drifts drifts = drifts_of<Dim>(start, record.history);
    folder.write(run.file(), as_csv(drifts));
    const auto& options = run.options;
    StudyTable::Row row{
        trial.name,
        options.method,
        options.dt ? fmt::format("{:.6g}", *options.dt) : "",
        options.dt ? "" : fmt::format("{:.4g}", options.rtol),
        std::to_string(s.rhs_evaluations),
        fmt::format("{:.4g}", static_cast<double>(s.rhs_evaluations) / std::max(s.t_end, 1e-300))};
    for (const auto& change : drifts.change) {
        const GrowthFit growth = fit_growth(drifts.t, change, round_off);
        row.insert(row.end(), {fmt::format("{:.6g}", growth.largest),
                               fmt::format("{:.6g}", growth.exponent), std::string(growth.kind())});
    }
    row.push_back(s.stopped.empty() ? "whole" : "stopped: " + s.stopped);
    row.push_back(fmt::format("{:.3g}", s.wall_seconds));
    return row;
}

template std::optional<StudyTable::Row> measure(const Trial<1>&, const LongRun&, const RunFolder&);
template std::optional<StudyTable::Row> measure(const Trial<2>&, const LongRun&, const RunFolder&);
template std::optional<StudyTable::Row> measure(const Trial<3>&, const LongRun&, const RunFolder&);

}  // namespace spam::drift_study

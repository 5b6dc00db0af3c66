// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift_study.hpp"
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam::drift_study {
namespace {

Promise promise_of(const Promises& promises, std::string_view invariant) {
    return invariant == "momentum"           ? promises.momentum
           : invariant == "angular_momentum" ? promises.angular_momentum
                                             : promises.energy;
}

double value(const StudyTable::Row& row, std::string_view invariant, const char* what) {
    return number_of(row, columns(), std::string(invariant) + what);
}

void check(Session& session, const TrialWords& trial, const StudyMethod& method,
           const StudyTable::Row& row) {
    for (const auto invariant : invariants) {
        const Promise promise = promise_of(trial.promises, invariant);
        if (promise == Promise::not_kept) continue;
        const std::string name = fmt::format("{}_{}_{}", trial.name, method.word(), invariant);
        const double drift = value(row, invariant, "_drift");
        if (!std::isfinite(drift)) continue;
        if (promise == Promise::exact)
            session.check({name + "_drift", drift, 0.0, 1e-11, "promised by the scheme: exact"});
        else
            session.measure(name + "_drift", drift, "largest, over its size");
        const auto& growth = cell(row, std::string(invariant) + "_growth");
        if (growth == "round-off") continue;
        Check exponent{name + "_exponent", value(row, invariant, "_exponent"), {}, 0.0, growth};
        if (method.separable && trial.smooth && invariant == "energy")
            exponent = {exponent.name, exponent.value, 0.0, 0.25, "symplectic: bounded"};
        session.check(exponent);
    }
}

void say_table(Session& session, const std::vector<TrialWords>& trials,
               const std::vector<StudyMethod>& methods, const std::vector<LongRun>& runs,
               const std::vector<StudyTable::Row>& rows) {
    auto& terminal = session.terminal();
    terminal.say("");
    terminal.say(fmt::format("{:<17}{:<22}{:>8}{:>9} {:>5}  {:<12}", "problem", "method", "calls/t",
                             "dE", "power", ""));
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const bool whole = cell(rows[k], "end") == "whole";
        terminal.say(
            fmt::format("{:<17}{:<22}{:>8}{:>9.1e} {:>5.2f}  {}", trials[runs[k].trial].name,
                        methods[runs[k].method].title(), cell(rows[k], "calls_per_time"),
                        value(rows[k], "energy", "_drift"), value(rows[k], "energy", "_exponent"),
                        whole ? cell(rows[k], "energy_growth") : cell(rows[k], "end")));
    }
}

/// Largest change so far: what a drift has come to.
LogLogCurve envelope(std::size_t key, const std::vector<double>& t,
                     const std::vector<double>& change) {
    LogLogCurve curve{key, false, {}, {}};
    double most = 0.0;
    for (std::size_t k = 1; k < t.size(); ++k) {
        most = std::max(most, change[k]);
        curve.x.push_back(t[k]);
        curve.y.push_back(most);
    }
    return curve;
}

/// One picture of an invariant, a panel for every system that keeps it.
void draw(Session& session, std::string_view invariant, const std::vector<TrialWords>& trials,
          const std::vector<StudyMethod>& methods, const std::vector<LongRun>& runs,
          double calls_per_time) {
    const bool energy = invariant == "energy";
    const auto place = static_cast<std::size_t>(
        std::find(invariants.begin(), invariants.end(), invariant) - invariants.begin());
    LogLogPicture picture{
        fmt::format("Largest change of {} so far, {:g} right-hand sides per unit of time",
                    energy ? "energy" : "angular momentum", calls_per_time),
        {},
        2,
        {},
        "In brackets: nominal order.",
        false};
    const RunFolder folder = session.folder().inside("drifts");
    for (std::size_t t = 0; t < trials.size(); ++t) {
        if (promise_of(trials[t].promises, invariant) == Promise::not_kept) continue;
        LogLogPanel panel{trials[t].title, "t", energy ? "|ΔE|/E" : "|ΔL|/L", {}, 0.0, {}};
        for (const LongRun& run : runs) {
            if (run.trial != t) continue;
            const Drifts drifts = read_drifts(folder / run.file());
            panel.curves.push_back(envelope(run.method, drifts.t, drifts.change[place]));
        }
        picture.panels.push_back(std::move(panel));
    }
    if (picture.panels.empty()) return;
    for (const StudyMethod& method : methods) picture.key.push_back(method.title());
    session.note_drawn(
        draw_log_log(session.plots_folder(), fmt::format("{}_drift", invariant), picture));
}

}  // namespace

void report(Session& session, const std::vector<TrialWords>& trials,
            const std::vector<StudyMethod>& methods, const std::vector<LongRun>& runs,
            const std::vector<StudyTable::Row>& rows, double calls_per_time) {
    say_table(session, trials, methods, runs, rows);
    for (std::size_t k = 0; k < runs.size(); ++k)
        check(session, trials[runs[k].trial], methods[runs[k].method], rows[k]);
    if (!session.plots()) return;
    for (const auto invariant : {"energy", "angular_momentum"})
        draw(session, invariant, trials, methods, runs, calls_per_time);
}

}  // namespace spam::drift_study

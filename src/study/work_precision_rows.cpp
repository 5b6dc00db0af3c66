// SPDX-License-Identifier: GPL-3.0-or-later
#include "work_precision.hpp"
#include <spam/diagnostics/invariants.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam::work_precision {
namespace {

constexpr double seconds_of_repeats = 0.05;

std::string words(double x, int digits = 6) {
    return std::isnan(x) ? "" : fmt::format("{:.{}g}", x, digits);
}

/// Changes of momentum, angular momentum and energy from start to end, over their sizes.
template <int Dim>
std::array<double, 3> drifts(const Start<Dim>& start, std::span<const double> y) {
    const auto before = measure_invariants<Dim>(*start.model, start.y0);
    const auto after = measure_invariants<Dim>(*start.model, y);
    const auto scales =
        conserved_scales<Dim>(*start.model, start.y0, std::max(before.kinetic, after.kinetic));
    const double turning = (after.angular_momentum - before.angular_momentum).norm();
    return {(after.momentum - before.momentum).norm() / scales.momentum,
            turning > 0.0 ? turning / scales.angular_momentum : 0.0,
            (after.energy - before.energy) / scales.energy};
}

}  // namespace

const std::vector<std::string>& columns() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all{
            "case",   "problem",   "method",      "steps",          "order",
            "dt",     "tolerance", "steps_taken", "rejected_steps", "rhs_evaluations",
            "events", "error",     "floor"};
        for (const Field field : fields)
            for (const char* norm : {"_rms", "_max"})
                all.push_back(std::string(field.name()) + norm);
        for (const char* name :
             {"momentum_drift", "angular_momentum_drift", "energy_drift", "end", "seconds"})
            all.emplace_back(name);
        return all;
    }();
    return names;
}

const std::string& cell(const StudyTable::Row& row, std::string_view column) {
    return cell_of(row, columns(), column);
}

double number(const StudyTable::Row& row, std::string_view column) {
    return number_of(row, columns(), column);
}

template <int Dim>
std::optional<StudyTable::Row> measure(const Trial<Dim>& trial, Reference<Dim>& reference,
                                       const StudyMethod& method, const IntegratorOptions& options,
                                       std::size_t most_calls) {
    const Start<Dim> start = trial.start();
    const auto best = reference.choose(start);
    if (!best) return {};
    const TrialRun run = integrate_trial<Dim>(start, options, trial.t_end, most_calls);
    if (run.interrupted) return {};
    const bool whole = run.stopped.empty();
    double seconds = run.seconds;
    FieldErrors errors;
    std::array<double, 3> changes;
    changes.fill(std::nan(""));
    if (whole) {
        seconds = least_seconds<Dim>(start, options, trial.t_end, run, seconds_of_repeats);
        errors = compare<Dim>(start, run.y, reference.solution(best->number).y);
        changes = drifts<Dim>(start, run.y);
    }
    const double error = whole ? errors.worst() : std::nan("");
    const auto& s = run.statistics;
    const bool fixed = options.dt.has_value();
    StudyTable::Row row{trial.name,
                        method.name,
                        fixed ? "fixed" : "adaptive",
                        std::to_string(method.order),
                        fixed ? words(*options.dt, 17) : "",
                        fixed ? "" : words(options.rtol),
                        std::to_string(s.steps),
                        std::to_string(s.rejected_steps),
                        std::to_string(s.rhs_evaluations),
                        std::to_string(s.events),
                        words(error, 9),
                        words(best->floor)};
    for (std::size_t f = 0; f < fields.size(); ++f)
        row.insert(row.end(), {words(errors.rms[f]), words(errors.largest[f])});
    for (const double change : changes) row.push_back(words(change));
    row.push_back(!whole                 ? "stopped: " + run.stopped
                  : error >= best->floor ? "measured"
                                         : "unknown: below the error of the reference");
    row.push_back(words(seconds));
    return row;
}

#define SPAM_INSTANTIATE(D)                                                                       \
    template std::optional<StudyTable::Row> measure(const Trial<D>&, Reference<D>&,               \
                                                    const StudyMethod&, const IntegratorOptions&, \
                                                    std::size_t);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam::work_precision

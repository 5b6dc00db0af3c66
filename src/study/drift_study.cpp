// SPDX-License-Identifier: GPL-3.0-or-later
#include "drift_study.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

namespace spam {

using namespace drift_study;

namespace {

constexpr double part_for_tolerance = 0.1;  // of the time

/// The tolerance with which a method costs so many right-hand sides per time: halving in its logarithm,
/// to a tenth of a decade.
template <int Dim>
double tolerance_of_cost(const Trial<Dim>& trial, const StudyMethod& method,
                         double calls_per_time) {
    const double t_end = part_for_tolerance * trial.t_end;
    const Start<Dim> start = trial.start();
    double loose = -1.0, tight = -13.0;
    while (loose - tight > 0.1) {
        const double middle = 0.5 * (loose + tight);
        const TrialRun run =
            integrate_trial<Dim>(start, method.with_tolerance(std::pow(10.0, middle)), t_end,
                                 static_cast<std::size_t>(4.0 * calls_per_time * t_end + 100.0));
        const auto calls = static_cast<double>(run.statistics.rhs_evaluations);
        (calls > calls_per_time * t_end ? tight : loose) = middle;
    }
    return std::pow(10.0, loose);
}

/// Fixed steps of that cost; of a method without them a tolerance still to be found. Throws InputError
/// where it cannot integrate the system.
template <int Dim>
IntegratorOptions options_of_cost(const Trial<Dim>& trial, const StudyMethod& method,
                                  double calls_per_time) {
    if (!method.fixed) {
        const auto options = method.with_tolerance(1e-3);
        integrate_trial<Dim>(trial.start(), options, 1e-6 * trial.t_end);
        return options;
    }
    const double calls = calls_per_step<Dim>(trial.start(), method.name, 1e-6 * trial.t_end);
    // As many steps as make the time: the last one is no shorter.
    return method.with_step(trial.t_end /
                            std::max(1.0, std::round(trial.t_end * calls_per_time / calls)));
}

}  // namespace

void DriftStudy::add_options(Options& options) {
    jobs_ = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    options.text("methods", methods_,
                 "methods to compare: names as for --integrator, separated by commas");
    options.number("calls-per-time", calls_per_time_, "right-hand sides per unit of time",
                   between(1e-3, 1e6));
    options.integer("jobs", jobs_, "number of runs computed at the same time", between(1, 1024));
    options.exclude_from_case({"jobs"});
}

template <int Dim>
void DriftStudy::run(Session& session, const std::vector<Trial<Dim>>& trials) {
    if (session.common().smoke && !session.given("methods")) methods_ = "rk4,arkode:VERNER_8_5_6";
    const auto methods = study_methods(methods_, standard_methods);
    std::vector<std::string> description{
        fmt::format("integrator  {} methods, {:g} right-hand sides per unit of time, {} at a time",
                    methods.size(), calls_per_time_, jobs_)};
    std::vector<TrialWords> words;
    std::vector<LongRun> runs;
    for (std::size_t t = 0; t < trials.size(); ++t) {
        const Trial<Dim>& trial = trials[t];
        if (!(calls_per_time_ * trial.t_end <= 1e10))
            throw InputError(fmt::format(
                "calls-per-time: {:g} would be {:.0e} right-hand sides to the end of {}, t = {:g}; "
                "choose fewer, or a shorter run",
                calls_per_time_, calls_per_time_ * trial.t_end, trial.name, trial.t_end));
        const Start<Dim> start = trial.start();
        words.push_back(
            {trial.name, trial.title, trial.t_end, start.model->promises(), trial.rough.empty()});
        description.push_back(fmt::format("{}: {}, {} particles, t = 0 to {:.6g}", trial.name,
                                          trial.title, start.model->particles().size(),
                                          trial.t_end));
        const std::size_t before = runs.size();
        std::string refused;
        for (std::size_t m = 0; m < methods.size(); ++m) try {
                runs.push_back({t, m, options_of_cost<Dim>(trial, methods[m], calls_per_time_)});
            } catch (const InputError& error) {
                refused = error.what();
                description.push_back(fmt::format("    without {}: {}", methods[m].name, refused));
            }
        if (runs.size() == before)
            throw InputError(
                fmt::format("methods: none of them can integrate {}: {}", trial.name, refused));
    }

    std::optional<RunFolder> folder;  // known once the study has begun
    std::vector<StudyTask> tasks;
    for (LongRun& run : runs) {
        const Trial<Dim>& trial = trials[run.trial];
        run.task = {trial.name + "/" + methods[run.method].name,
                    [this, &trial, &run, &folder, &method = methods[run.method]] {
                        if (!method.fixed)
                            run.options = method.with_tolerance(
                                tolerance_of_cost<Dim>(trial, method, calls_per_time_));
                        return measure<Dim>(trial, run, *folder);
                    }};
        tasks.push_back(run.task);
    }
    StudyTable table = session.begin_study("invariant_drift", columns(), description, true);
    folder = session.folder().inside("drifts");
    if (!session.run_study(table, tasks, jobs_)) return;
    report(session, words, methods, runs, table.rows(tasks), calls_per_time_);
}

#define SPAM_INSTANTIATE(D) template void DriftStudy::run(Session&, const std::vector<Trial<D>>&);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

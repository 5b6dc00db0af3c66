// SPDX-License-Identifier: GPL-3.0-or-later
#include "work_precision.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace spam {

using namespace work_precision;

namespace {

constexpr double reference_tolerance = 1e-13, reference_work = 2.0;
constexpr int halvings = 8;  // of the work, down the ladder

/// Why a method cannot integrate a system; empty where it can.
template <int Dim>
std::string refusal(const Start<Dim>& start, const StudyMethod& method, double t_end, bool fixed) {
    try {
        if (fixed)
            calls_per_step<Dim>(start, method.name, 1e-6 * t_end);
        else  // a first step tells
            integrate_trial<Dim>(start, method.with_tolerance(1e-3), 1e-6 * t_end);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// Everything that is to be done, made before anything is written.
template <int Dim>
class Agenda {
  public:
    Agenda(const std::vector<Trial<Dim>>& trials, const std::vector<StudyMethod>& methods,
           StepKind steps, int calls, double tightest)
        : trials_(trials),
          methods_(methods),
          steps_(steps),
          calls_(calls),
          tightest_(tightest) {
        for (std::size_t t = 0; t < trials.size(); ++t) add_trial(t);
    }

    std::vector<std::string> description{};
    std::vector<StudyTask> reference_tasks{};
    std::vector<Branch> branches{};

    std::vector<StudyTask> tasks() const {
        std::vector<StudyTask> all;
        for (const Branch& branch : branches)
            all.insert(all.end(), branch.tasks.begin(), branch.tasks.end());
        return all;
    }

    /// Samples of all branches from the rows of all tasks; what is known of the systems.
    std::vector<TrialWords> read(const std::vector<StudyTable::Row>& rows) {
        std::vector<TrialWords> words;
        auto row = rows.begin();
        for (Branch& branch : branches) {
            const Trial<Dim>& trial = trials_[branch.trial];
            if (words.size() == branch.trial)
                words.push_back({trial.name, trial.title, trial.rough, particles_[branch.trial],
                                 trial.t_end, number(*row, "floor")});
            for (std::size_t k = 0; k < branch.tasks.size(); ++k, ++row)
                branch.samples.push_back({number(*row, "dt"), number(*row, "rhs_evaluations"),
                                          number(*row, "seconds"), number(*row, "error"),
                                          cell(*row, "end") == "measured"});
        }
        return words;
    }

  private:
    void add_trial(std::size_t t) {
        const Trial<Dim>& trial = trials_[t];
        const Start<Dim> start = trial.start();
        particles_.push_back(start.model->particles().size());
        description.push_back(fmt::format("{}: {}, {} particles, t = 0 to {:.6g}", trial.name,
                                          trial.title, particles_.back(), trial.t_end));
        add_reference(trial, start);
        std::string refused;
        const std::size_t before = branches.size();
        for (std::size_t m = 0; m < methods_.size(); ++m)
            for (const bool fixed : {true, false}) {
                const StudyMethod& method = methods_[m];
                if (!(fixed ? method.fixed && steps_ != StepKind::adaptive
                            : method.adaptive && steps_ != StepKind::fixed))
                    continue;
                refused = refusal<Dim>(start, method, trial.t_end, fixed);
                if (!refused.empty()) {
                    description.push_back(fmt::format("    without {}: {}", method.name, refused));
                    continue;
                }
                branches.push_back({t, m, fixed});
                fixed ? add_fixed(branches.back(), start) : add_adaptive(branches.back());
            }
        if (branches.size() == before)
            throw InputError(fmt::format("methods: none of them can integrate {} with {} steps{}",
                                         trial.name, to_string(steps_),
                                         refused.empty() ? "" : ": " + refused));
    }

    void add_reference(const Trial<Dim>& trial, const Start<Dim>& start) {
        std::vector<IntegratorOptions> options;
        const auto methods = study_methods("arkode:FEHLBERG_13_7_8,arkode:VERNER_8_5_6", {});
        for (const StudyMethod& method : methods)
            options.push_back(method.with_tolerance(reference_tolerance));
        for (const StudyMethod& method : methods) {
            const double calls = calls_per_step<Dim>(start, method.name, 1e-6 * trial.t_end);
            options.push_back(
                method.with_step(trial.t_end / std::ceil(reference_work * calls_ / calls)));
        }
        Reference<Dim>& reference = references_.emplace_back(trial, std::move(options));
        for (std::size_t k = 0; k < reference.size(); ++k)
            reference_tasks.push_back({trial.name + ": " + reference.name(k),
                                       [&reference, k]() -> std::optional<StudyTable::Row> {
                                           const TrialRun& run = reference.solution(k);
                                           if (run.interrupted) return {};
                                           return StudyTable::Row{
                                               std::to_string(run.statistics.rhs_evaluations),
                                               fmt::format("{:.3g}", run.seconds),
                                               run.stopped.empty() ? "whole" : run.stopped};
                                       }});
    }

    void add_task(Branch& branch, const std::string& name, const IntegratorOptions& options) {
        const Trial<Dim>& trial = trials_[branch.trial];
        const StudyMethod& method = methods_[branch.method];
        Reference<Dim>& reference = references_.back();
        const auto most = static_cast<std::size_t>(1.5 * calls_);
        branch.tasks.push_back({fmt::format("{}/{}/{}", trial.name, method.name, name),
                                [&trial, &method, &reference, options, most] {
                                    return measure<Dim>(trial, reference, method, options, most);
                                }});
    }

    void add_fixed(Branch& branch, const Start<Dim>& start) {
        const Trial<Dim>& trial = trials_[branch.trial];
        const StudyMethod& method = methods_[branch.method];
        const double calls = calls_per_step<Dim>(start, method.name, 1e-6 * trial.t_end);
        double last = 0.0;
        for (int k = 2 * halvings; k >= 0; --k) {
            const double n = std::max(1.0, std::round(calls_ * std::pow(2.0, -0.5 * k) / calls));
            if (n != std::exchange(last, n))
                add_task(branch, fmt::format("n={:.0f}", n), method.with_step(trial.t_end / n));
        }
    }

    void add_adaptive(Branch& branch) {
        for (int e = 2; std::pow(10.0, -e) > 0.99 * tightest_; ++e)
            add_task(branch, fmt::format("tolerance=1e-{}", e),
                     methods_[branch.method].with_tolerance(std::pow(10.0, -e)));
    }

    const std::vector<Trial<Dim>>& trials_;
    const std::vector<StudyMethod>& methods_;
    StepKind steps_;
    double calls_, tightest_;
    std::vector<std::size_t> particles_;
    std::deque<Reference<Dim>> references_;
};

}  // namespace

std::string_view to_string(StepKind kind) {
    return kind == StepKind::both ? "both" : kind == StepKind::fixed ? "fixed" : "adaptive";
}

void WorkPrecision::add_options(Options& options) {
    jobs_ = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    options.text("methods", methods_,
                 "methods to compare: names as for --integrator, separated by commas");
    options.choice<StepKind>(
        "steps", steps_, {StepKind::both, StepKind::fixed, StepKind::adaptive},
        "whether the methods take fixed steps, adaptive steps, or both in turn");
    options.integer("calls", calls_, "largest number of right-hand sides of a run",
                    between(500, 1e8));
    options.number("tightest", tightest_, "tightest tolerance of adaptive steps",
                   between(1e-14, 1e-2));
    options.integer(
        "jobs", jobs_,
        "number of runs computed at the same time; 1 where seconds are to be undisturbed",
        between(1, 1024));
    options.exclude_from_case({"jobs"});
}

template <int Dim>
void WorkPrecision::run(Session& session, const std::vector<Trial<Dim>>& trials) {
    if (session.common().smoke) {
        if (!session.given("calls")) calls_ = 4'000;
        if (!session.given("tightest")) tightest_ = 1e-8;
        if (!session.given("methods")) methods_ = "rk4,arkode:DORMAND_PRINCE_7_4_5";
    }
    const auto methods = study_methods(methods_, standard_methods);
    Agenda<Dim> agenda(trials, methods, steps_, calls_, tightest_);
    const auto tasks = agenda.tasks();
    std::vector<std::string> description{
        fmt::format("integrator  {} methods, {} runs of at most {} right-hand sides, {} at a time",
                    methods.size(), tasks.size(), calls_, jobs_)};
    description.insert(description.end(), agenda.description.begin(), agenda.description.end());

    StudyTable table = session.begin_study("integrator_accuracy", columns(), description, true);
    if (table.known() < tasks.size()) {
        StudyTable references(session.folder(), "references",
                              {"case", "rhs_evaluations", "seconds", "end"});
        if (!session.run_study(references, agenda.reference_tasks, jobs_)) return;
    }
    if (!session.run_study(table, tasks, jobs_)) return;
    const auto trial_words = agenda.read(table.rows(tasks));
    report(session, trial_words, methods, agenda.branches);
}

template void WorkPrecision::run(Session&, const std::vector<Trial<1>>&);
template void WorkPrecision::run(Session&, const std::vector<Trial<2>>&);
template void WorkPrecision::run(Session&, const std::vector<Trial<3>>&);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "work_precision.hpp"

#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <thread>

namespace spam {

using namespace work_precision;

namespace {

constexpr double reference_tolerance = 1e-13;
constexpr double seconds_of_repeats = 0.05;
constexpr int halvings = 8;  // of the work, down the ladder

constexpr std::array fields{Field::position, Field::velocity, Field::density, Field::stress,
                            Field::energy};

/// Root mean square and largest of every field of a difference, over the fields' scales.
struct FieldErrors {
    std::array<double, fields.size()> rms, largest;
    double worst() const {
        double most = 0.0;
        for (const double e : rms)
            if (!std::isnan(e)) most = std::max(most, e);
        return most;
    }
};

double rms(std::span<const double> x) {
    double sum = 0.0;
    for (const double value : x) sum += value * value;
    return std::sqrt(sum / static_cast<double>(x.size()));
}

template <int Dim>
FieldErrors compare(const Start<Dim>& start, std::span<const double> y,
                    std::span<const double> reference) {
    FieldErrors errors;
    errors.rms.fill(std::nan(""));
    errors.largest.fill(std::nan(""));
    const auto& layout = start.model->layout();
    for (std::size_t f = 0; f < fields.size(); ++f) {
        const auto* block = layout.find(fields[f]);
        if (block == nullptr) continue;
        const std::size_t size = block->components * layout.particles();
        const auto of = [&](std::span<const double> z) { return z.subspan(block->offset, size); };
        double scale = start.model->particles().spacing;
        if (fields[f] != Field::position) scale = std::max(rms(of(start.y0)), rms(of(reference)));
        if (!(scale > 0.0)) scale = block->scale;
        std::vector<double> difference(size);
        double largest = 0.0;
        for (std::size_t k = 0; k < size; ++k) {
            difference[k] = (of(y)[k] - of(reference)[k]) / scale;
            largest = std::max(largest, std::abs(difference[k]));
        }
        errors.rms[f] = rms(difference);
        errors.largest[f] = largest;
    }
    return errors;
}

/// Two solutions of a system as good as can be had, each computed when first asked for.
template <int Dim>
class Reference {
  public:
    Reference(const Trial<Dim>& trial, std::vector<StudyMethod> methods)
        : trial_(trial),
          methods_(std::move(methods)) {}

    const TrialRun& solution(std::size_t k) {
        const std::lock_guard lock(solutions_[k].mutex);
        TrialRun& run = solutions_[k].run;
        if (run.y.empty() || run.interrupted)
            run = integrate_trial<Dim>(
                trial_.start(), methods_[k].with_tolerance(reference_tolerance), trial_.t_end);
        if (!run.stopped.empty())
            throw GuardStop(
                fmt::format("the reference of {} by {}: {}", trial_.name, name(k), run.stopped));
        return run;
    }
    const std::string& name(std::size_t k) const { return methods_[k].name; }
    bool interrupted() { return solution(0).interrupted || solution(1).interrupted; }
    double floor(const Start<Dim>& start) {
        return std::max(1e-16, compare<Dim>(start, solution(1).y, solution(0).y).worst());
    }

  private:
    struct Solution {
        std::mutex mutex;
        TrialRun run;
    };
    const Trial<Dim>& trial_;
    std::vector<StudyMethod> methods_;
    std::array<Solution, 2> solutions_;
};

std::string words(double x, int digits = 6) {
    return std::isnan(x) ? "" : fmt::format("{:.{}g}", x, digits);
}

/// The cells of a row after its name. Nothing where a signal interrupted the run.
template <int Dim>
std::optional<StudyTable::Row> measure(const Trial<Dim>& trial, Reference<Dim>& reference,
                                       const StudyMethod& method, const IntegratorOptions& options,
                                       std::size_t most_calls) {
    if (reference.interrupted()) return {};
    const Start<Dim> start = trial.start();
    const TrialRun run = integrate_trial<Dim>(start, options, trial.t_end, most_calls);
    if (run.interrupted) return {};
    const bool whole = run.stopped.empty();
    const double seconds =
        whole ? least_seconds<Dim>(start, options, trial.t_end, run, seconds_of_repeats)
              : run.seconds;
    const double floor = reference.floor(start), nothing = std::nan("");
    FieldErrors errors;
    errors.rms.fill(nothing);
    errors.largest.fill(nothing);
    double p = nothing, L = nothing, E = nothing;
    if (whole) {
        errors = compare<Dim>(start, run.y, reference.solution(0).y);
        const auto before = measure_invariants<Dim>(*start.model, start.y0);
        const auto after = measure_invariants<Dim>(*start.model, run.y);
        const auto scales =
            conserved_scales<Dim>(*start.model, start.y0, std::max(before.kinetic, after.kinetic));
        p = (after.momentum - before.momentum).norm() / scales.momentum;
        L = (after.angular_momentum - before.angular_momentum).norm() / scales.angular_momentum;
        E = (after.energy - before.energy) / scales.energy;
    }
    const double error = whole ? errors.worst() : nothing;
    const auto& s = run.statistics;
    StudyTable::Row row{trial.name,
                        method.name,
                        options.dt ? "fixed" : "adaptive",
                        std::to_string(method.order),
                        options.dt ? words(*options.dt, 17) : "",
                        options.dt ? "" : words(options.rtol),
                        std::to_string(s.steps),
                        std::to_string(s.rejected_steps),
                        std::to_string(s.rhs_evaluations),
                        std::to_string(s.events),
                        words(error, 9),
                        words(floor)};
    for (std::size_t f = 0; f < fields.size(); ++f) {
        row.push_back(words(errors.rms[f]));
        row.push_back(words(errors.largest[f]));
    }
    for (const double drift : {p, L, E}) row.push_back(words(drift));
    row.push_back(!whole           ? "stopped: " + run.stopped
                  : error >= floor ? "measured"
                                   : "unknown: below the error of the reference");
    row.push_back(words(seconds));
    return row;
}

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

double number(const std::string& cell) { return cell.empty() ? std::nan("") : std::stod(cell); }

Sample point_of(const StudyTable::Row& row) {
    const auto cell = [&](const char* name) { return number(row[column(name)]); };
    return {cell("dt"), cell("rhs_evaluations"), cell("seconds"), cell("error"),
            row[column("end")] == "measured"};
}

}  // namespace

const std::vector<std::string>& work_precision::columns() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all{
            "case",   "problem",   "method",      "steps",          "order",
            "dt",     "tolerance", "steps_taken", "rejected_steps", "rhs_evaluations",
            "events", "error",     "floor"};
        for (const Field field : fields)
            for (const char* norm : {"_rms", "_max"})
                all.push_back(std::string(field_name(field)) + norm);
        for (const char* name :
             {"momentum_drift", "angular_momentum_drift", "energy_drift", "end", "seconds"})
            all.emplace_back(name);
        return all;
    }();
    return names;
}

std::size_t work_precision::column(std::string_view name) {
    const auto& all = columns();
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin());
}

std::string_view to_string(StepKind kind) {
    return kind == StepKind::both ? "both" : kind == StepKind::fixed ? "fixed" : "adaptive";
}

void WorkPrecision::add_options(Options& options) {
    jobs_ = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    options.text("methods", methods_, "names as --integrator takes them, separated by commas");
    options.choice<StepKind>("steps", steps_, {StepKind::both, StepKind::fixed, StepKind::adaptive},
                             "which steps each method takes");
    options.integer("calls", calls_, "right-hand sides of a run, at most", between(500, 1e9));
    options.number("tightest", tightest_, "tolerance of adaptive steps", between(1e-14, 1e-3));
    options.integer("jobs", jobs_, "runs computed at a time; 1 for undisturbed seconds",
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
    const auto methods = study_methods(methods_, available_methods(standard_methods));
    auto checks_of_reference = available_methods({"gsl:rk8pd", "arkode:VERNER_8_5_6"});
    checks_of_reference.resize(1);
    const auto referees =
        study_methods("arkode:FEHLBERG_13_7_8," + checks_of_reference.front(), {});

    std::deque<Reference<Dim>> references;
    std::vector<Start<Dim>> starts;
    std::vector<Measured> curves;
    std::vector<std::vector<StudyTask>> tasks_of_curves;
    std::vector<StudyTask> reference_tasks;
    std::vector<std::string> description{fmt::format(
        "integrator  {} methods, at most {} right-hand sides a run, {} at a time; "
        "references {} and {}, tolerance {:g}",
        methods.size(), calls_, jobs_, referees[0].name, referees[1].name, reference_tolerance)};
    for (std::size_t t = 0; t < trials.size(); ++t) {
        const Trial<Dim>& trial = trials[t];
        Reference<Dim>& reference = references.emplace_back(trial, referees);
        const Start<Dim>& start = starts.emplace_back(trial.start());
        description.push_back(fmt::format("{:<12}{}: {} particles, t = 0 to {:.6g}", trial.name,
                                          trial.title, start.model->particles().size(),
                                          trial.t_end));
        for (const std::size_t k : {0, 1})
            reference_tasks.push_back({trial.name + "/" + reference.name(k),
                                       [&reference, k]() -> std::optional<StudyTable::Row> {
                                           const TrialRun& run = reference.solution(k);
                                           if (run.interrupted) return {};
                                           return StudyTable::Row{
                                               std::to_string(run.statistics.rhs_evaluations),
                                               words(run.seconds)};
                                       }});
        std::string refused;
        const std::size_t before = curves.size();
        for (std::size_t m = 0; m < methods.size(); ++m)
            for (const bool fixed : {true, false}) {
                const StudyMethod& method = methods[m];
                if (!(fixed ? method.fixed && steps_ != StepKind::adaptive
                            : method.adaptive && steps_ != StepKind::fixed))
                    continue;
                if (refused = refusal<Dim>(start, method, trial.t_end, fixed); !refused.empty()) {
                    description.push_back(
                        fmt::format("            without {}: {}", method.name, refused));
                    continue;
                }
                curves.push_back({{t, m, fixed}});
                auto& tasks = tasks_of_curves.emplace_back();
                const auto most = static_cast<std::size_t>(calls_);
                const auto add = [&](const std::string& name, auto options) {
                    tasks.push_back({fmt::format("{}/{}/{}", trial.name, method.name, name),
                                     [&trial, &reference, &method, options, most] {
                                         return measure<Dim>(trial, reference, method, options(),
                                                             most + most / 10);
                                     }});
                };
                if (fixed) {
                    const double calls =
                        calls_per_step<Dim>(start, method.name, 1e-6 * trial.t_end);
                    double before_n = 0.0;
                    for (int k = 2 * halvings; k >= 0; --k) {
                        const double work = calls_ * std::pow(2.0, -0.5 * k);
                        const double n = std::max(1.0, std::round(work / calls));
                        if (n == std::exchange(before_n, n)) continue;
                        add(fmt::format("n={:.0f}", n),
                            [&method, dt = trial.t_end / n] { return method.with_step(dt); });
                    }
                } else {
                    for (double e = 2.0; std::pow(10.0, -e) > 0.99 * tightest_; e += 1.0)
                        add(fmt::format("tolerance=1e-{:.0f}", e),
                            [&method, e] { return method.with_tolerance(std::pow(10.0, -e)); });
                }
            }
        if (curves.size() == before)
            throw InputError(fmt::format("methods: none of them can integrate {}{}", trial.name,
                                         refused.empty() ? " with such steps" : ": " + refused));
    }
    std::vector<StudyTask> tasks;
    for (const auto& some : tasks_of_curves) tasks.insert(tasks.end(), some.begin(), some.end());

    StudyTable table = session.begin_study("integrator_accuracy", columns(), description, true);
    if (table.known() < tasks.size()) {
        StudyTable of_references(session.folder(), "references",
                                 {"case", "rhs_evaluations", "seconds"});
        if (!session.run_study(of_references, reference_tasks, jobs_)) return;
    }
    if (!session.run_study(table, tasks, jobs_)) return;

    const auto rows = table.rows(tasks);
    std::vector<TrialWords> trial_words;
    for (std::size_t t = 0, row = 0, c = 0; t < trials.size(); ++t) {
        trial_words.push_back({trials[t].name, trials[t].title, trials[t].rough,
                               number(rows[row][column("floor")]),
                               starts[t].model->particles().size(), trials[t].t_end});
        for (; c < curves.size() && curves[c].curve.trial == t; ++c)
            for (std::size_t k = 0; k < tasks_of_curves[c].size(); ++k)
                curves[c].points.push_back(point_of(rows[row++]));
    }
    report(session, trial_words, methods, curves);
}

template void WorkPrecision::run(Session&, const std::vector<Trial<1>>&);
template void WorkPrecision::run(Session&, const std::vector<Trial<2>>&);
template void WorkPrecision::run(Session&, const std::vector<Trial<3>>&);

}  // namespace spam

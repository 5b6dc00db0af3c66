// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/checkpoint_pair.hpp>
#include <spam/io/run_folder.hpp>
#include <spam/io/study_table.hpp>
#include <spam/io/terminal.hpp>
#include <spam/problem/plan.hpp>
#include <spam/problem/problem.hpp>

#include <chrono>
#include <exception>
#include <type_traits>

namespace spam {

struct CaseMemory;
template <int Dim>
class Run;
template <int Dim>
class SnapshotSeries;

/// One invocation of a problem, as its body sees it. Build everything first, then run: nothing is
/// written before the first run() or begin_...(), so that whatever is wrong with the input is found
/// before.
class Session {
  public:
    ~Session();

    /// Whether the user set this option (command line or file).
    bool given(std::string_view option) const { return problem_.options_.given(option); }
    /// Values of the options that every problem has.
    const CommonOptions& common() const { return problem_.common_; }
    /// In smoke runs, `smoke` becomes the value of an option that is not given.
    template <class Value>
    void smoke_default(std::string_view option, Value& value,
                       std::type_identity_t<Value> smoke) const {
        if (common().smoke && !given(option)) value = smoke;
    }
    /// --t-end, or what the problem plans: `usual`, in smoke runs `smoke`.
    double end(double usual, double smoke) const {
        return common().t_end.value_or(common().smoke ? smoke : usual);
    }
    /// The scheme that the options say; the standard one without use_scheme().
    const Scheme& scheme() const { return problem_.scheme_; }
    /// Throws InputError where the options of the integrator mean nothing.
    const IntegratorOptions& integrator() const {
        if (refused_integrator_) std::rethrow_exception(refused_integrator_);
        return integrator_;
    }

    /// The step of rk4, where none is given, of a case that needs another one than the problem's.
    void prefer_step(double dt);
    /// The same of leapfrog, which is then the method where none is given.
    void prefer_leapfrog(double dt);

    /// For bodies that measure processor time: sums in one thread where --threads does not ask for more.
    void prefer_one_thread() { chooses_threads_ = false; }

    /// The processes of --ranks, or a single one; for a body that distributes a model itself (PartedMotion). To be
    /// called before begin_analysis(), which otherwise refuses several.
    Parts& processes() {
        parts_itself_ = true;
        return problem_.processes();
    }

    /// Keys that case.toml must not hold, where only the body can know (else a rule of Options says so).
    void leave_out_of_case(const std::vector<std::string>& names) {
        problem_.options_.leave_out(names);
    }

    /// Runs one case; its results are the result folder itself.
    template <int Dim>
    RunRecord run(Model<Dim>& model, std::vector<double> y0, Plan<Dim> plan);

    /// Runs several, each in a folder of its own named by its label. A case stopped by a guard is
    /// recorded and the next one begins, unless it starts from that one (Case::start); then, and after a
    /// signal, no further case is begun and fewer records come back. Precondition: the first case has a y0.
    template <int Dim>
    std::vector<RunRecord> run_all(std::vector<Case<Dim>> cases);

    /// For a problem that integrates nothing, in place of run(): says what will be analysed, line by
    /// line, ends a dry run, and makes the result folder. Options of running and integrating must
    /// not be given. What comes back is for statistics.json; the time until the end is added to it. `steps`: how it
    /// integrates where it does so with steps of its own.
    RunStatistics& begin_analysis(const std::vector<std::string>& description,
                                  const std::string& steps = {});

    /// For a study of many small runs, in place of run(): likewise, and opens its table. A study of the
    /// same case that was stopped, by whatever, is gone on with; throws InputError where the folder
    /// holds an unfinished one of another case. `of_integrators`: the study says itself how it
    /// integrates, options of the integrator must not be given.
    StudyTable begin_study(const std::string& table, const std::vector<std::string>& columns,
                           const std::vector<std::string>& description,
                           bool of_integrators = false);
    /// StudyTable::run() with a progress line. False after a signal.
    bool run_study(StudyTable& table, const std::vector<StudyTask>& tasks, int threads);

    /// For a long computation from finished runs that writes nothing: completes the results so far and calls
    /// it. A signal meanwhile, or one that came before, ends the process at once.
    void evaluate(const std::function<void()>& computation);

    /// Something measured, for result.json; printed at the end.
    void measure(std::string name, double value, std::string source = "measured");
    /// The same, and what it must be.
    void check(Check check);
    /// Claimed where `known`, else only measured.
    void claim(Check check, bool known);
    /// Whether these options have their default values, and the run is no smoke test: where something is
    /// known of the default case alone.
    bool when_default(const std::vector<std::string>& options) const {
        return !problem_.common_.smoke && at_default(options);
    }
    /// The same of smoke runs too, whose own values must not be among these.
    bool at_default(const std::vector<std::string>& options) const {
        return problem_.options_.at_default(options);
    }
    /// Checks that every invariant drifted no more than promised, here and under this prefix. Of runs that
    /// are not given to this the session does so itself at the end, with the label of the case.
    void check_promises(const RunRecord& record, const std::string& prefix = "");

    /// As the problem declared them.
    const UnitNames& units() const { return problem_.units_; }
    /// For lines of a problem's own.
    Terminal& terminal() { return terminal_; }
    /// The folder of pictures; precondition: a run has begun and plots() is true.
    RunFolder plots_folder() const { return folder_->inside("plots"); }
    /// Whether pictures are wanted, and there is a folder for them.
    bool plots() const { return folder_ && !problem_.common_.no_plots; }
    /// Says once that pictures could not be drawn.
    void note_drawn(bool drawn);

    /// The result folder; precondition: a run has begun.
    const RunFolder& folder() const { return *folder_; }

  private:
    friend class Problem;
    Session(Problem& problem, const IntegratorOptions& integrator, std::exception_ptr refused,
            std::string command);

    [[noreturn]] void end_dry_run();
    void choose_threads(std::size_t particles);
    void open_folder();
    std::string case_file() const;
    void write_case_file();
    void save_first();
    void save_checkpoint();
    void save_last(std::size_t number, CaseMemory&& state);
    CaseMemory* earlier_case(std::size_t number) const;
    template <int Dim>
    void check_restart(std::vector<Case<Dim>>& cases) const;
    template <int Dim>
    void begin_anew(const RunFolder& folder, SnapshotSeries<Dim>& snapshots);
    template <int Dim>
    void resume(Run<Dim>& run, CaseMemory& earlier, const RunFolder& folder,
                SnapshotSeries<Dim>& snapshots);
    void begin(const std::vector<std::string>& description, const char* study,
               bool of_integrators = false);
    bool continues(const char* study) const;
    void describe_environment();
    void say_units();
    void write_results_so_far();
    int finish();
    template <int Dim>
    void settle_plan(Plan<Dim>& plan, std::size_t number);
    template <int Dim>
    IntegratorOptions integrator_of(const Plan<Dim>& plan) const {
        IntegratorOptions own = integrator_;
        const bool other = plan.method && !given("integrator");
        if (other) own.method = *plan.method;
        if (plan.step && (other || own.method == "rk4") && !given("dt"))
            own.dt = *plan.step * problem_.relative_step_;
        return own;
    }
    template <int Dim>
    void refuse_idle_balance(const std::vector<Case<Dim>>& cases);
    template <int Dim>
    void refuse_unstable(const Case<Dim>& one) const;
    template <int Dim>
    void refuse_endless(const Case<Dim>& one) const;
    template <int Dim>
    void describe(const Case<Dim>& one);
    template <int Dim>
    RunRecord run_one(Case<Dim>& one, const RunFolder& folder);
    template <int Dim>
    typename Run<Dim>::Watchers watchers_of(Run<Dim>& run, const Case<Dim>& one,
                                            SnapshotSeries<Dim>& snapshots);
    void report(const RunRecord& record);
    void check_promises(const std::vector<Drift>& drifts, const std::string& prefix);
    void check_promises_left();
    void print_checks();
    std::string where_rows_are() const;

    Problem& problem_;
    IntegratorOptions integrator_;
    std::exception_ptr refused_integrator_;  ///< why there is none; null where there is one
    int threads_;
    bool chooses_threads_;
    std::string command_;
    Terminal terminal_;
    std::optional<RunFolder> folder_;
    std::unique_ptr<SessionMemory> memory_;      ///< of the cases begun
    std::optional<CheckpointPair> checkpoints_;  ///< in the folder
    std::vector<Check> checks_;
    /// What runs promised and has not been checked yet.
    struct Promised {
        std::string label;
        std::vector<Drift> drifts;
    };
    std::vector<Promised> promised_;
    std::vector<RunStatistics> statistics_;
    std::optional<std::chrono::steady_clock::time_point> analysis_start_;
    std::string guard_reason_;
    bool warned_about_plots_ = false, parts_itself_ = false;
};

}  // namespace spam

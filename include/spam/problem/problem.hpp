// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parts.hpp>
#include <spam/core/unit_names.hpp>
#include <spam/io/options.hpp>
#include <spam/io/run_folder.hpp>
#include <spam/physics/scheme.hpp>
#include <spam/problem/drift_guard.hpp>
#include <spam/problem/integrator_settings.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace spam {

class Session;
struct SessionMemory;

/// Options every problem has.
struct CommonOptions {
    /// --out: the result folder.
    std::string out;
    bool force = false;                      ///< --force: an existing folder is moved aside
    bool dry_run = false;                    ///< --dry-run: says what would be done
    bool smoke = false;                      ///< --smoke: a version of seconds, for tests
    bool quiet = false;                      ///< --quiet: errors only
    bool no_plots = false;                   ///< --no-plots
    std::optional<int> threads;              ///< unset: as many as gain
    std::optional<int> ranks;                ///< --ranks: processes; unset: one
    std::optional<double> t_end;             ///< --t-end; unset: what the problem plans
    std::optional<double> output_every;      ///< --output-every, between rows of invariants.csv
    std::optional<double> snapshot_every;    ///< --snapshot-every
    std::optional<double> checkpoint_every;  ///< --checkpoint-every
    /// --restart: a result folder or a checkpoint; empty without.
    std::string restart;
    /// --guard and --limit-...: what happens where an invariant changes by more than is promised.
    DriftLimits guard{DriftAction::warn, {}, {}, {}};
};

/// By what a step that serves the usual range of a weight function must be multiplied for `range`: 1 down to two
/// thirds of it (2 spacings where 3 are usual), and the square of what is left of these below. There a sum over a few
/// neighbours is stiffer than an integral would be; measured, tests/problem/short_ranges.cpp.
double step_of_short_range(double range, double usual);

/// A problem executable: its options, and the exit status contract around its body.
///     0 done, checks hold    1 a check fails       2 bad input       3 numerical guard
///     4 output failed        128 + signal (130, 143) interrupted
class Problem {
  public:
    /// `default_dt`: the step of rk4 when none is given; `default_step`: what --help says of it where it depends
    /// on other options (Session::prefer_step), as "0.1 spacings by the speed of sound".
    Problem(std::string name, std::string summary, double default_dt = 0.1,
            std::string default_step = "");

    ~Problem();

    /// For options of the problem itself.
    Options& options() { return options_; }

    /// Declares the units of its numbers, for --help, the first lines of a run, rows, snapshots and pictures.
    void units(UnitNames units);

    /// Adds the scheme and kernel options; `standard` holds their defaults. Steps that are not given
    /// (default_dt, Session::prefer_step, Plan::step) are meant for its weight function, and shorter with a
    /// steeper one and with a short range (step_of_short_range).
    void use_scheme(const Scheme& standard = {});
    /// Of the options that use_scheme() adds.
    static const std::vector<std::string>& scheme_option_names();
    /// Of --guard and its limits.
    static const std::vector<std::string>& guard_option_names();

    /// Parses, runs `body`, completes the results. Returns the exit status.
    int main(int argc, char** argv, const std::function<void(Session&)>& body);

  private:
    friend class Session;
    std::string recall_case(const std::string& name);
    void settle_restart();
    void add_guard_options();

    std::string name_, summary_;
    UnitNames units_;
    IntegratorSettings integrator_;
    Options options_;
    CommonOptions common_;
    Scheme scheme_;
    Kernel standard_kernel_ = scheme_.kernel;
    double standard_range_ = scheme_.range;
    int run(int argc, char** argv, const std::function<void(Session&)>& body);
    int refusal() const;
    void settle_ranks();
    int complain(const std::exception& error, int status) const;
    /// Those among which runs are parted; one that is alone where there is one.
    Parts& processes() const { return processes_ ? *processes_ : Parts::alone_here(); }
    /// Whether another process writes what this one finds as well.
    bool muted() const { return processes().own() > 0; }

    std::unique_ptr<Parts> processes_;
    double relative_step_ = 1.0;              ///< of the weight function chosen, with its range
    std::unique_ptr<SessionMemory> earlier_;  ///< of --restart
    std::string restart_file_;
    /// The result folder of the checkpoint, where it is in one.
    std::optional<RunFolder> restarted_;
    /// The same, where results go on in it.
    std::optional<RunFolder> reopened_;
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint.hpp"
#include <spam/core/error.hpp>
#include <spam/core/instruction_set.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/text.hpp>
#include <spam/core/threads.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/problem/session.hpp>

#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <regex>

namespace spam {
namespace {

constexpr const char* last_checkpoint = "checkpoint_last.h5";

/// Without where results go and how many processes and threads find them: no checkpoint differs by these words.
std::string without_place_and_processors(const std::string& command) {
    static const std::regex option(R"( --(out|ranks|threads)[ =]\S+)");
    return std::regex_replace(command, option, "");
}

}  // namespace

Session::Session(Problem& problem, const IntegratorOptions& integrator, std::exception_ptr refused,
                 std::string command)
    : problem_(problem),
      integrator_(integrator),
      refused_integrator_(std::move(refused)),
      threads_(problem.common_.threads.value_or(1)),
      chooses_threads_(!problem.common_.threads),
      command_(std::move(command)),
      terminal_(problem.common_.quiet),
      memory_(std::make_unique<SessionMemory>()) {
    memory_->version = version();
    memory_->instruction_set = to_string(instruction_set());
    memory_->problem = problem.name_;
    memory_->command = without_place_and_processors(command_);
    memory_->smoke = problem.common_.smoke;
}

Session::~Session() = default;

void Session::prefer_step(double dt) {
    dt *= problem_.relative_step_;
    if (problem_.integrator_.prefer_step(dt, problem_.options_)) integrator_.dt = dt;
}

void Session::prefer_leapfrog(double dt) {
    if (!problem_.integrator_.prefer_leapfrog(dt * problem_.relative_step_, problem_.options_))
        return;
    integrator_ = problem_.integrator_.resolve(problem_.options_);
}

/// As many as gain by it, of those that can be had, where none were asked for.
void Session::choose_threads(std::size_t particles) {
    if (!chooses_threads_) return;
    const int each = std::max(1, usable_cores() / static_cast<int>(problem_.processes().count()));
    const int wanted = worthwhile_threads(particles / problem_.processes().count(), each);
    if (wanted <= threads_) return;
    try {
        start_threads(wanted);
        threads_ = wanted;
    } catch (const InputError&) {  // none were asked for
    }
}

/// The folder comes into being with the first run: everything before may still be refused.
void Session::open_folder() {
    if (folder_) return write_case_file();
    if (problem_.reopened_)
        folder_ = problem_.reopened_;
    else
        folder_.emplace(problem_.common_.out, problem_.common_.force);
    terminal_.log_to(*folder_ / "run.log");
    describe_environment();
    memory_->case_toml = problem_.options_.case_toml();
    write_case_file();
}

/// The options as they were given or chosen; of ends and intervals those that hold for all cases.
std::string Session::case_file() const {
    const std::pair<const char*, double PlanMemory::*> parts[] = {
        {"t-end", &PlanMemory::t_end},
        {"output-every", &PlanMemory::output_every},
        {"snapshot-every", &PlanMemory::snapshot_every},
        {"checkpoint-every", &PlanMemory::checkpoint_every}};
    const auto& plans = memory_->plans;
    std::map<std::string, std::string> chosen;
    std::string different;
    if (problem_.common_.smoke) chosen["smoke"] = "true";
    for (const auto& [name, value] : parts) {
        std::string all;
        bool same = true;
        for (const PlanMemory& plan : plans) {
            all += fmt::format(" {}", plan.*value);
            same = same && plan.*value == plans.front().*value;
        }
        if (plans.empty()) continue;
        if (same)
            chosen[name] = fmt::format("{}", plans.front().*value);
        else
            different += fmt::format("# {} of the cases, in order:{}\n", name, all);
    }
    return problem_.options_.case_toml(chosen) + different;
}

void Session::write_case_file() { folder_->write("case.toml", case_file()); }

void Session::say_units() {
    if (problem_.units_.declared())
        terminal_.say(fmt::format("units       {}", problem_.units_.describe()));
}

void Session::describe_environment() {
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    terminal_.say(fmt::format("{}: {}", problem_.name_, problem_.summary_));
    terminal_.say(fmt::format("command     {}", command_));
    terminal_.say(fmt::format("built       spam {}, SUNDIALS {}, Eigen {}.{}.{}, compiler {}",
                              version(), sundials_version(), EIGEN_WORLD_VERSION,
                              EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, __VERSION__));
    terminal_.say(fmt::format("machine     {}, {} thread{}, {}", host.data(), threads_,
                              threads_ == 1 ? "" : "s", to_string(instruction_set())));
    if (!problem_.processes().alone())
        terminal_.say(
            fmt::format("ranks       {}, among which particles are parted by recursive bisection",
                        problem_.processes().count()));
    terminal_.say(fmt::format("results     {}", folder_->path().string()));
    say_units();
    const SessionMemory* earlier = problem_.earlier_.get();
    if (earlier == nullptr) return;
    terminal_.say(fmt::format("restart     {}, {}", problem_.common_.restart,
                              earlier->cases.empty() || !earlier->cases.back().has_state()
                                  ? "from the start"
                                  : fmt::format("t = {:.6g}", earlier->cases.back().t)));
    if (!earlier->on_schedule)
        terminal_.say(
            "note        this state is off the checkpoint schedule: last digits may differ from "
            "those "
            "of a run that was never stopped. --restart with the folder's name goes on from the "
            "last "
            "checkpoint on the schedule and gives the same bytes.");
    const auto warn = [&](const char* what, const std::string& then, const std::string& now) {
        if (then != now)
            terminal_.warn(fmt::format(
                "{}: the checkpoint was written by {} {}, this is {}: last digits may differ",
                problem_.name_, what, one_line(then), one_line(now)));
    };
    warn("version", earlier->version, memory_->version);
    warn("instruction set", earlier->instruction_set, memory_->instruction_set);
}

CaseMemory* Session::earlier_case(std::size_t number) const {
    SessionMemory* earlier = problem_.earlier_.get();
    if (earlier == nullptr || number >= earlier->cases.size()) return nullptr;
    return earlier->cases[number].has_state() ? &earlier->cases[number] : nullptr;
}

/// A state on the schedule; a later one off it has had its day.
void Session::save_checkpoint() {
    if (!checkpoints_) checkpoints_.emplace(folder_->path());
    checkpoints_->save(checkpoint_file(*memory_));
    std::error_code ignored;
    std::filesystem::remove(*folder_ / last_checkpoint, ignored);
}

/// Before the first step, so that whatever stops a run leaves something to go on from: no case begun, or
/// what a run in another folder had come to.
void Session::save_first() {
    SessionMemory* earlier = problem_.earlier_.get();
    if (problem_.reopened_ || !memory_->cases.empty()) return;
    if (earlier == nullptr) return save_checkpoint();
    earlier->case_toml = memory_->case_toml;
    earlier->plans = memory_->plans;
    checkpoints_.emplace(folder_->path());
    checkpoints_->save(checkpoint_file(*earlier));
}

/// The state in which a case ended off the schedule goes into a file of its own. What --restart goes on
/// from stays the state on the schedule, in the file as in the memory.
void Session::save_last(std::size_t number, CaseMemory&& state) {
    std::swap(memory_->cases[number], state);
    memory_->on_schedule = false;
    checkpoint_file(*memory_).save(*folder_ / last_checkpoint);
    memory_->on_schedule = true;
    std::swap(memory_->cases[number], state);
}

void Session::measure(std::string name, double value, std::string source) {
    check({std::move(name), value, {}, 0.0, std::move(source)});
}

void Session::check(Check check) { checks_.push_back(std::move(check)); }

void Session::claim(Check check, bool known) {
    if (known) return this->check(std::move(check));
    measure(std::move(check.name), check.value);
}

void Session::check_promises(const RunRecord& record, const std::string& prefix) {
    std::erase_if(promised_, [&](const Promised& one) { return one.label == record.label; });
    check_promises(record.drifts, prefix);
}

/// So that no problem can forget what its runs have promised.
void Session::check_promises_left() {
    for (const auto& [label, drifts] : promised_)
        check_promises(drifts, label.empty() ? label : label + "_");
    promised_.clear();
}

void Session::check_promises(const std::vector<Drift>& drifts, const std::string& prefix) {
    for (const Drift& drift : drifts) {
        if (drift.promise == Promise::not_kept) continue;
        std::string name = prefix + drift.name + "_drift";
        std::ranges::replace(name, ' ', '_');
        check({name, drift.change, 0.0, drift.limit,
               fmt::format("promise of the scheme: {}", to_string(drift.promise))});
    }
}

void Session::note_drawn(bool drawn) {
    if (drawn || warned_about_plots_) return;
    warned_about_plots_ = true;
    terminal_.warn(fmt::format(
        "{}: no pictures: gnuplot is missing or failed; the scripts are in the plots folder",
        problem_.name_));
}

void Session::report(const RunRecord& record) {
    terminal_.say(fmt::format("{:<18}{:<21}{}", "invariant", "promise", "change"));
    for (const Drift& drift : record.drifts)
        terminal_.say(fmt::format("{:<18}{:<21}{:<11.1e}{}", drift.name, to_string(drift.promise),
                                  drift.change,
                                  drift.promise == Promise::not_kept ? "-"
                                  : drift.kept()                     ? "kept"
                                                                     : "BROKEN"));
    promised_.push_back({record.label, record.drifts});
    const RunStatistics& s = record.statistics;
    terminal_.say(fmt::format("{} steps, {} rejected, {} right-hand sides, {:.2f} s", s.steps,
                              s.rejected_steps, s.rhs_evaluations, s.wall_seconds));
    if (!s.limited_by.empty()) terminal_.say(fmt::format("limited by  {}", s.limits_in_words()));
}

void Session::print_checks() {
    if (checks_.empty()) return;
    terminal_.say("");
    terminal_.say("checks");
    for (const Check& check : checks_) {
        std::string claim;
        if (check.expected)
            claim = fmt::format(" (expected {:.6g} +- {:.2g})", *check.expected, check.tolerance);
        else if (!check.holds())
            claim = " (no finite number)";
        const auto line = fmt::format("{:<6}{} = {:.6g}{}",
                                      !check.holds()    ? "FAIL"
                                      : !check.expected ? "-"
                                                        : "ok",
                                      check.name, check.value, claim);
        // What decides the exit status is an error, which --quiet prints.
        if (common().quiet && !check.holds())
            terminal_.warn(problem_.name_ + ": " + line);
        else
            terminal_.say(line);
    }
}

void Session::write_results_so_far() {
    write_results(*folder_, checks_);
    if (statistics_.empty()) return;  // stopped within the first run
    if (analysis_start_)
        statistics_.front().wall_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - *analysis_start_)
                .count();
    if (statistics_.size() > 1 || !std::filesystem::exists(*folder_ / "statistics.json")) {
        RunStatistics total = statistics_.front();
        for (std::size_t k = 1; k < statistics_.size(); ++k) total.add(statistics_[k]);
        write_statistics(*folder_, total);
    }
}

void Session::evaluate(const std::function<void()>& computation) {
    // The promises of the runs are checked where the problem wants them; a signal must not lose them.
    const auto checks = checks_;
    const auto promised = promised_;
    check_promises_left();
    write_results_so_far();
    checks_ = checks;
    promised_ = promised;
    const InterruptWatch::AtOnce at_once;
    computation();
}

/// Of several cases, which have a folder each.
std::string Session::where_rows_are() const {
    std::vector<std::string> folders;
    for (const CaseMemory& one : memory_->cases)
        if (!one.label.empty()) folders.push_back(one.label + "/");
    if (folders.empty()) return {};
    return fmt::format(", the rows of each case (invariants.csv) in {}", fmt::join(folders, ", "));
}

/// Completes the results and decides the exit status.
int Session::finish() {
    if (!folder_) return 0;
    check_promises_left();
    write_results_so_far();
    const int signal = InterruptWatch::received();
    if (signal == 0 && guard_reason_.empty()) print_checks();
    terminal_.say(fmt::format("results in {}{}", folder_->path().string(), where_rows_are()));
    if (signal != 0) {
        terminal_.warn(fmt::format("{}: interrupted by signal {}; the results so far are complete",
                                   problem_.name_, signal));
        return 128 + signal;
    }
    if (!guard_reason_.empty()) {
        terminal_.warn(fmt::format("{}: stopped: {}", problem_.name_, guard_reason_));
        return 3;
    }
    return std::ranges::all_of(checks_, [](const Check& c) { return c.holds(); }) ? 0 : 1;
}

}  // namespace spam

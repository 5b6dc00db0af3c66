// SPDX-License-Identifier: GPL-3.0-or-later
// What a session does besides runs: analyses, and studies of many small runs.
#include "../io/file_descriptor.hpp"
#include "dry_run.hpp"
#include "duration.hpp"
#include <spam/core/error.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/problem/session.hpp>

#include <fmt/format.h>

namespace spam {

void Session::end_dry_run() {
    terminal_.say("");
    terminal_.say(
        fmt::format("dry run: nothing computed; results would go to {}", problem_.common_.out));
    throw DryRunDone{};
}

/// Whether the folder holds an unfinished study of this case.
bool Session::continues(const char* study) const {
    const std::filesystem::path folder = problem_.common_.out;
    if (problem_.common_.force || !StudyTable::unfinished(folder, study)) return false;
    std::string begun;
    try {
        begun = contents_of_file(folder / "case.toml");
    } catch (const InputError& refusal) {
        throw InputError(fmt::format("out: '{}' cannot be read: {}; choose another --out",
                                     (folder / "case.toml").string(), refusal.what()));
    }
    if (begun != case_file())
        throw InputError(fmt::format(
            "out: '{}' holds an unfinished study of another case (its case.toml); give the same "
            "options to go on with it, --force to begin anew, or another --out",
            folder.string()));
    return true;
}

/// `study`: the name of its table, or null.
void Session::begin(const std::vector<std::string>& description, const char* study,
                    bool of_integrators) {
    const auto describe = [&] {
        for (const auto& line : description) terminal_.say(line);
        if (!of_integrators)
            terminal_.say(fmt::format("integrator  {}", study != nullptr ? integrator_.describe()
                                                                         : "none: nothing moves"));
    };
    if (!problem_.processes().alone() && !parts_itself_)
        throw InputError(fmt::format(
            "ranks: {} computes no single run whose particles could be parted; leave --ranks out",
            problem_.name_));
    if (problem_.common_.dry_run) {
        terminal_.say(fmt::format("{}: {}", problem_.name_, problem_.summary_));
        say_units();
        describe();
        end_dry_run();
    }
    if (study != nullptr && continues(study)) {
        // The session's only once it is accepted: until then what is wrong is the input.
        auto folder = RunFolder::reopen(problem_.common_.out);
        if (!continues(study))  // another run may have ended between the first look and the lock
            throw InputError(fmt::format(
                "out: another run has just completed the study in '{}'; choose another --out",
                problem_.common_.out));
        folder.check_own();
        folder_ = std::move(folder);
        terminal_.log_to(*folder_ / "run.log");
        describe_environment();
    } else {
        open_folder();
    }
    describe();
    analysis_start_ = std::chrono::steady_clock::now();
    statistics_.push_back({});
    statistics_.back().problem = problem_.name_;
    statistics_.back().units = problem_.units_;
}

RunStatistics& Session::begin_analysis(const std::vector<std::string>& description,
                                       const std::string& steps) {
    std::vector<std::string> of_runs{"t-end", "output-every", "snapshot-every", "checkpoint-every",
                                     "restart"};
    const auto& of_integrator = IntegratorSettings::names();
    of_runs.insert(of_runs.end(), of_integrator.begin(), of_integrator.end());
    const auto& of_guard = Problem::guard_option_names();
    of_runs.insert(of_runs.end(), of_guard.begin(), of_guard.end());
    if (const auto name = problem_.options_.first_given(of_runs); !name.empty())
        throw InputError(
            fmt::format("{}: {} {}; leave it out", name, problem_.name_,
                        steps.empty() ? "integrates nothing" : "chooses its own steps and end"));
    leave_out_of_case(of_runs);
    if (given("balance"))
        throw InputError("balance: both choices are the same for one body; leave it out");
    leave_out_of_case({"balance"});
    integrator();
    auto lines = description;
    if (!steps.empty()) lines.push_back("integrator  " + steps);
    begin(lines, nullptr, !steps.empty());
    return statistics_.back();
}

StudyTable Session::begin_study(const std::string& table, const std::vector<std::string>& columns,
                                const std::vector<std::string>& description, bool of_integrators) {
    std::vector<std::string> of_one_run{"t-end", "output-every", "snapshot-every",
                                        "checkpoint-every"};
    const auto& of_guard = Problem::guard_option_names();
    of_one_run.insert(of_one_run.end(), of_guard.begin(), of_guard.end());
    if (of_integrators)
        of_one_run.insert(of_one_run.end(), IntegratorSettings::names().begin(),
                          IntegratorSettings::names().end());
    if (problem_.options_.given("restart"))
        throw InputError(
            "restart: a study goes on from its table when it is started again with the same "
            "options; leave --restart out");
    if (common().threads)
        throw InputError(fmt::format(
            "threads: {} computes many small runs at a time, each in one thread; {}",
            problem_.name_, problem_.options_.has("jobs") ? "use --jobs" : "leave it out"));
    if (const auto name = problem_.options_.first_given(of_one_run); !name.empty())
        throw InputError(fmt::format("{}: has no meaning for the many runs of {}; leave it out",
                                     name, problem_.name_));
    leave_out_of_case(of_one_run);
    integrator();
    begin(description, table.c_str(), of_integrators);
    try {
        return {*folder_, table, columns};
    } catch (const InputError&) {  // of a damaged table: nothing has been computed
        folder_.reset();
        throw;
    }
}

bool Session::run_study(StudyTable& table, const std::vector<StudyTask>& tasks, int threads) {
    InterruptWatch::complete_results();
    const std::size_t had = table.known();
    if (had > 0) terminal_.say(fmt::format("{} of {} are known already", had, tasks.size()));
    terminal_.begin_progress();
    const auto progress = [&](std::size_t known) {
        const double fraction = static_cast<double>(known) / static_cast<double>(tasks.size());
        if (!terminal_.progress_due(fraction)) return;
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - *analysis_start_)
                .count();
        const double left =
            seconds * static_cast<double>(tasks.size() - known) / static_cast<double>(known - had);
        terminal_.progress(fraction, fmt::format("{:3.0f} %  {} of {}  left {}", 100.0 * fraction,
                                                 known, tasks.size(), duration(left)));
    };
    const bool complete = table.run(tasks, threads, progress);
    terminal_.end_progress();
    return complete;
}

}  // namespace spam

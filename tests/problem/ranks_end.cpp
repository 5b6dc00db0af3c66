// SPDX-License-Identifier: GPL-3.0-or-later
// How runs on several processes (--ranks) end, and go on on others.
#include "problem/ranks.hpp"
#include "problem/short_runs.hpp"
#include "support/effort.hpp"
#include <spam/core/program.hpp>

#include <nlohmann/json.hpp>

#include <sstream>
#include <thread>

using namespace spam::test;
namespace fs = std::filesystem;

namespace {

/// Minutes long, with rows from the first second on.
const Words long_run{"--transport",    "monaghan", "--turns", "50",
                     "--output-every", "0.5",      "--ranks", "2",
                     "--no-plots",     "--out",    "out"};

/// Processes that have this word among their arguments.
std::vector<pid_t> processes_with(const std::string& word) {
    std::vector<pid_t> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        std::ifstream in(entry.path() / "cmdline");
        std::stringstream words;
        words << in.rdbuf();
        if (words.str().find(word) != std::string::npos) found.push_back(std::stoi(name));
    }
    return found;
}

void wait_for_rows(Child& child, const fs::path& csv) {
    BOOST_REQUIRE(child.wait_for(
        [&](const Outcome&) { return fs::exists(csv) && lines(contents_of(csv)) > 3; }));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_that_was_stopped_goes_on_on_other_ranks) {
    if (no_ranks()) return;
    const Scratch folder;
    const Words gas{"--cells", "16", "--t-end", "40", "--checkpoint-every", "3", "--no-plots"};
    require_ran(run_in(folder, "free_expansion", with(gas, {"--out", "whole"})));
    Child child(problem("free_expansion", with(gas, {"--out", "stopped", "--ranks", "2"})),
                {folder.path()});
    BOOST_REQUIRE(child.wait_for(
        [&](const Outcome&) { return fs::exists(folder / "stopped/checkpoint_1.h5"); }));
    child.send(SIGTERM);
    const Outcome stopped = child.finish();
    BOOST_TEST(stopped.status == 143);
    BOOST_TEST(lines(stopped.err) == 1U, stopped.err);
    require_ran(
        run_in(folder, "free_expansion", {"--restart", "stopped", "--no-plots", "--ranks", "3"}));
    check_same(files_of(folder / "whole"), files_of(folder / "stopped"));
}

BOOST_AUTO_TEST_CASE(ends) {
    if (no_ranks()) return;
    const Scratch folder;
    const auto check = [&](const Words& arguments, int status, const std::string& says) {
        const Outcome outcome =
            run_in(folder, "rotating_hexagon", with(arguments, {"--ranks", "3"}));
        BOOST_TEST(outcome.status == status, outcome.err);
        BOOST_TEST(outcome.err.find(says) != std::string::npos, outcome.err);
        BOOST_TEST(lines(outcome.err) == 1U, outcome.err);
    };
    check({"--size", "none"}, 2, "size");
    check({"--out", "out", "--no-plots", "--transport", "plain", "--dt", "10", "--size", "3"}, 3,
          "density");
    BOOST_TEST(fs::exists(folder / "out/checkpoint_0.h5"));
    check({"--out", "out"}, 2, "out: ");
    check({"--integrator", "gsl:rkf45", "--no-plots", "--out", "gsl"}, 2, "ranks: ");
}

BOOST_AUTO_TEST_CASE(signals_complete_the_results) {
    if (no_ranks()) return;
    for (const auto& [signal, status] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
        const Scratch folder;
        Child child(problem("rotating_hexagon", long_run), {folder.path()});
        wait_for_rows(child, folder / "out/invariants.csv");
        child.send(signal);
        const Outcome outcome = child.finish();
        BOOST_TEST(outcome.status == status);
        BOOST_TEST(lines(outcome.err) == 1U, outcome.err);
        const auto statistics = json_of(folder / "out/statistics.json");
        BOOST_TEST(statistics.at("stopped").get<std::string>().find("signal") != std::string::npos);
    }
}

BOOST_AUTO_TEST_CASE(a_rank_that_is_killed_ends_all) {
    if (no_ranks()) return;
    const Scratch folder;
    const std::string marked = (folder / "out").string();
    Words words = long_run;
    words.back() = marked;
    Child child(problem("rotating_hexagon", words), {folder.path()});
    wait_for_rows(child, folder / "out/invariants.csv");
    pid_t youngest = 0;
    for (const pid_t one : processes_with(marked)) youngest = std::max(youngest, one);
    BOOST_REQUIRE(youngest > 0);
    kill(youngest, SIGKILL);
    const Outcome outcome = child.finish(Child::Seconds(30));
    BOOST_TEST(outcome.status != 0);
    BOOST_TEST(outcome.status != -1);
    BOOST_TEST(outcome.err.find("been killed") != std::string::npos, outcome.err);
    for (int tenths = 0; tenths < 50 && !processes_with(marked).empty(); ++tenths)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    BOOST_TEST(processes_with(marked).empty());
}

/// Every fiftieth of 200 places, all of them in long runs: set-up, the first lists, steps, rows, checkpoints.
BOOST_AUTO_TEST_CASE(an_exception_between_any_two_exchanges_ends_all) {
    if (no_ranks()) return;
    const auto run_failing = [](std::size_t in, std::size_t at) {
        const Scratch folder;
        Launch launch{folder.path()};
        launch.before_exec = [in, at] {
            setenv("SPAM_FAIL_IN", std::to_string(in).c_str(), 1);
            setenv("SPAM_FAIL_AT", std::to_string(at).c_str(), 1);
        };
        return Child({SPAM_FAILING_PROBLEM, "--smoke", "--no-plots", "--quiet", "--ranks", "2",
                      "--integrator", "arkode:DORMAND_PRINCE_7_4_5", "--output-every", "0.1"},
                     launch)
            .finish(Child::Seconds(30));
    };
    for (std::size_t at = 1; at <= 200; at += long_runs() ? 1 : 50)
        for (const std::size_t in : {0U, 1U}) BOOST_TEST_CONTEXT(at << " in " << in) {
                const Outcome outcome = run_failing(in, at);
                BOOST_TEST(outcome.status > 0, "it did not end by itself within 30 s");
                BOOST_TEST(outcome.err.find("thrown by a test") != std::string::npos, outcome.err);
                BOOST_TEST(lines(outcome.err) == 1U, outcome.err);
            }
    BOOST_TEST(run_failing(0, 1'000'000).status == 0);
}

/// One line with `word`, and a status, where this variable of the environment is "/nowhere".
void check_start_without(const char* variable, int status, const char* word) {
    const Scratch folder;
    Launch launch{folder.path()};
    launch.before_exec = [variable] { setenv(variable, "/nowhere", 1); };
    const Outcome outcome =
        Child(problem("free_expansion", {"--ranks", "2"}), launch).finish(Child::Seconds(60));
    BOOST_TEST(outcome.status == status);
    BOOST_TEST(lines(outcome.err) == 1U, outcome.err);
    BOOST_TEST(outcome.err.find(word) != std::string::npos, outcome.err);
}

BOOST_AUTO_TEST_CASE(without_what_starts_them_ranks_are_refused) {
    check_start_without("PATH", 2, "openmpi-bin");
    if (!no_ranks()) check_start_without("TMPDIR", 4, "TMPDIR");
}

// SPDX-License-Identifier: GPL-3.0-or-later
// One signal ends a program at once where there are no results to complete: during set-up, a dry run or
// an analysis, also one that follows motion.
#include "problem/twins.hpp"
#include "support/effort.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <thread>

using namespace spam::test;

namespace {

struct Busy {
    std::string program;
    Words arguments;  ///< busy for many seconds before its first step, or without one
};

const std::vector<Busy> all{
    {"free_expansion", {"--cells", "900"}},
    {"stability", {"--cells", "200"}},
    {"lattice_stability", {"--cells", "24", "--potential", "both"}},
    {"shock_tube", {"--compare"}},
    {"turns_survived", {}},
};

/// What a program that has begun its long part says to a signal: at once.
Outcome ended_by(Child& child, int signal) {
    std::this_thread::sleep_for(Child::Seconds(0.4));
    const auto sent = std::chrono::steady_clock::now();
    child.send(signal);
    Outcome outcome = child.finish();
    const Child::Seconds took = std::chrono::steady_clock::now() - sent;
    BOOST_TEST(outcome.status == 128 + signal);
    BOOST_TEST(took.count() < 1.0);
    return outcome;
}

}  // namespace

BOOST_AUTO_TEST_CASE(one_signal_is_enough) {
    // Every second one: all programs and all signals.
    std::size_t number = 0;
    for (const Busy& busy : all)
        for (const int signal : {SIGTERM, SIGINT, SIGHUP})
            if (long_runs() || number++ % 2 == 0)
                BOOST_TEST_CONTEXT(busy.program << ", signal " << signal) {
                    const Scratch folder;
                    Child child(
                        problem(busy.program, with(busy.arguments, {"--no-plots", "--out", "o"})),
                        {folder.path()});
                    const Outcome outcome = ended_by(child, signal);
                    BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
                    BOOST_TEST(outcome.err.starts_with(busy.program + ": interrupted by signal"));
                }
}

/// What the motion has left is complete when the analysis of it begins, and its end is not waited for.
BOOST_AUTO_TEST_CASE(one_signal_is_enough_after_motion) {
    for (const int signal : {SIGTERM, SIGINT}) BOOST_TEST_CONTEXT("signal " << signal) {
            const Scratch folder;
            Child child(problem("lattice_stability", {"--cells", "24", "--block", "10", "--t-end",
                                                      "1", "--no-plots", "--out", "o"}),
                        {folder.path()});
            BOOST_REQUIRE(child.wait_for([&](const Outcome&) {
                return std::filesystem::exists(folder / "o/both/statistics.json");
            }));
            const Outcome outcome = ended_by(child, signal);
            BOOST_TEST(outcome.err == "lattice_stability: interrupted by signal " +
                                          std::to_string(signal) +
                                          "; the results so far are complete\n");
            Words checked;
            for (const auto& check : json_of(folder / "o/result.json"))
                checked.push_back(check.at("name").get<std::string>());
            BOOST_TEST(std::count(checked.begin(), checked.end(), "both_energy_drift") == 1);
            BOOST_TEST(json_of(folder / "o/statistics.json").at("steps").get<double>() > 4 * 30);
            for (const auto& [name, text] : folder.listing())
                BOOST_TEST(!name.ends_with(".tmp"), name << " is left over");
        }
}

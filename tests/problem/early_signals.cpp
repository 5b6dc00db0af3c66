// SPDX-License-Identifier: GPL-3.0-or-later
// One signal ends a program at once where there are no results to complete: during set-up, a dry run or
// an analysis.
#include "problem/twins.hpp"

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
};

}  // namespace

BOOST_AUTO_TEST_CASE(one_signal_is_enough) {
    for (const Busy& busy : all)
        for (const int signal : {SIGTERM, SIGINT, SIGHUP})
            BOOST_TEST_CONTEXT(busy.program << ", signal " << signal) {
                const Scratch folder;
                Child child(
                    problem(busy.program, with(busy.arguments, {"--no-plots", "--out", "o"})),
                    {folder.path()});
                std::this_thread::sleep_for(Child::Seconds(0.4));
                const auto sent = std::chrono::steady_clock::now();
                child.send(signal);
                const Outcome outcome = child.finish();
                const Child::Seconds took = std::chrono::steady_clock::now() - sent;
                BOOST_TEST(outcome.status == 128 + signal);
                BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
                BOOST_TEST(outcome.err.starts_with(busy.program + ": interrupted by signal"));
                BOOST_TEST(took.count() < 1.0);
            }
}

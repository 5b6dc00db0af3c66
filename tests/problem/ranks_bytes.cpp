// SPDX-License-Identifier: GPL-3.0-or-later
// Every problem leaves the bytes of one process on several (--ranks), whichever ranks and threads it runs on. A
// quarter of the problems in each of ctest's lines (SPAM_QUARTER), all without.
#include "problem/ranks.hpp"
#include "problem/short_runs.hpp"
#include "support/effort.hpp"

#include <cstdlib>

using namespace spam::test;
namespace fs = std::filesystem;

namespace {

/// Of ctest's lines.
bool only_in_the_first() {
    const char* const quarter = std::getenv("SPAM_QUARTER");
    return quarter != nullptr && std::string(quarter) != "0";
}

/// A tenth of the time, and of that between checkpoints: exchanges cost most where cores are shared.
Words shorter(Words arguments) {
    static const std::set<std::string> times{
        "--t-end", "--turns", "--time", "--periods", "--relaxation-time", "--checkpoint-every"};
    for (std::size_t k = 1; k < arguments.size(); ++k)
        if (times.contains(arguments[k - 1]))
            arguments[k] = std::to_string(0.1 * std::stod(arguments[k]));
    return arguments;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_problem_leaves_the_bytes_of_one_rank) {
    if (no_ranks()) return;
    std::size_t number = 0;
    const char* const quarter = std::getenv("SPAM_QUARTER");
    for (const auto& run : all_short_runs()) BOOST_TEST_CONTEXT(run.first) {
            const auto& name = run.first;  // clang 14 captures no structured bindings
            const auto& arguments = run.second;
            ++number;
            if (quarter != nullptr && number % 4 != std::strtoul(quarter, nullptr, 10)) continue;
            BOOST_TEST_MESSAGE(name);  // a time limit shows where it was
            // One of two methods in turn on 2 ranks, every fifth problem on 2 to 4 with 1 or 2 threads each; all of
            // these in long runs.
            for (const bool fixed : {true, false}) {
                if (!long_runs() && fixed != (number % 2 == 0)) continue;
                const Scratch folder;
                const Words common =
                    with(shorter(arguments),
                         {"--integrator", fixed ? "rk4" : "arkode:DORMAND_PRINCE_7_4_5",
                          "--no-plots", "--quiet"});
                require_ran(run_in(folder, name, with(common, {"--out", "whole"})));
                const auto whole = files_of(folder / "whole", true);
                const auto check = [&](std::size_t ranks, std::size_t threads) {
                    BOOST_TEST_CONTEXT(ranks << " ranks of " << threads << " threads") {
                        fs::remove_all(folder / "parted");
                        require_ran(
                            run_in(folder, name,
                                   with(common, {"--ranks", std::to_string(ranks), "--threads",
                                                 std::to_string(threads), "--out", "parted"})));
                        check_same(whole, files_of(folder / "parted", true));
                    }
                };
                if (!long_runs()) {
                    const bool several = number % 5 == 0;
                    check(several ? 2 + number % 3 : 2, several ? 1 + number / 2 % 2 : 1);
                    continue;
                }
                for (const std::size_t ranks : {1U, 2U, 3U, 4U})
                    for (const std::size_t threads : {1U, 2U}) check(ranks, threads);
            }
        }
}

/// Rows of bonds stay with their particle, and a checkpoint of them goes on on another number of ranks.
BOOST_AUTO_TEST_CASE(material_vectors_leave_the_bytes_of_one_rank) {
    if (no_ranks() || only_in_the_first()) return;
    const Words common{"--formulation", "material_vectors", "--smoke", "--no-plots", "--quiet"};
    const Scratch folder;
    require_ran(run_in(folder, "rotating_hexagon", with(common, {"--out", "whole"})));
    for (const char* ranks : {"2", "3", "4"}) {
        const std::string out = std::string("parted_") + ranks;
        require_ran(
            run_in(folder, "rotating_hexagon", with(common, {"--ranks", ranks, "--out", out})));
        check_same(files_of(folder / "whole", true), files_of(folder / out, true));
    }
    const Words bar{"--smoke", "--no-plots", "--quiet", "--output-every", "0.5"};
    require_ran(run_in(folder, "pierced_bar", with(bar, {"--t-end", "6", "--out", "bar"})));
    require_ran(run_in(folder, "pierced_bar",
                       with(bar, {"--t-end", "3", "--ranks", "3", "--out", "half"})));
    require_ran(
        run_in(folder, "pierced_bar",
               {"--restart", "half", "--t-end", "6", "--no-plots", "--quiet", "--ranks", "2"}));
    BOOST_TEST((contents_of(folder / "bar/invariants.csv") ==
                contents_of(folder / "half/invariants.csv")));
}

/// A linear solver takes as many directions on every rank, or they wait for each other.
BOOST_AUTO_TEST_CASE(an_implicit_method_leaves_the_bytes_of_one_rank) {
    if (no_ranks() || only_in_the_first()) return;
    const Scratch folder;
    const Words common{"--formulation", "total_lagrangian", "--integrator", "cvode:bdf",
                       "--smoke",       "--no-plots",       "--quiet"};
    require_ran(
        run_in(folder, "rotating_hexagon", with(common, {"--ranks", "3", "--out", "parted"})));
    require_ran(run_in(folder, "rotating_hexagon", with(common, {"--out", "whole"})));
    check_same(files_of(folder / "whole", true), files_of(folder / "parted", true));
}

// SPDX-License-Identifier: GPL-3.0-or-later
// One run, one folder: whoever comes second is refused, and a lock does not outlive its process.
#include "problem/twins.hpp"

#include <chrono>
#include <random>
#include <thread>

using namespace spam::test;
namespace fs = std::filesystem;

namespace {

Words hexagon(const std::string& seconds_of_work, const Words& more) {
    return problem("rotating_hexagon",
                   with({"--size", "4", "--transport", "plain", "--no-plots", "--quiet", "--t-end",
                         seconds_of_work, "--checkpoint-every", "5"},
                        more));
}

void check_refused(const Outcome& outcome) {
    BOOST_TEST(outcome.status == 2, outcome.out << outcome.err);
    BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1, outcome.err);
    BOOST_TEST(outcome.err.find("still at work in") != std::string::npos, outcome.err);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_folder_at_work_is_refused) {
    const Scratch folder;
    Child first(hexagon("1e6", {"--out", "o"}), {folder.path()});
    BOOST_REQUIRE(
        first.wait_for([&](const Outcome&) { return fs::exists(folder / "o/checkpoint_1.h5"); }));
    check_refused(run(hexagon("1", {"--out", "o"}), {folder.path()}));
    check_refused(run(hexagon("1", {"--out", "o", "--force"}), {folder.path()}));
    check_refused(run(problem("rotating_hexagon", {"--restart", "o"}), {folder.path()}));
    check_refused(
        run(problem("rotating_hexagon", {"--restart", "o", "--out", "p"}), {folder.path()}));
    BOOST_TEST(!fs::exists(folder / "p"));
    BOOST_TEST(!fs::exists(folder / "o.old-1"));
    first.send(SIGKILL);
    first.finish();
    // Nothing of the lock is left.
    const Outcome next = run(hexagon("1", {"--out", "o", "--force"}), {folder.path()});
    BOOST_TEST(next.status == 0, next.err);
}

/// Two at once, at random distances: exactly one writes, and what it leaves is whole.
BOOST_AUTO_TEST_CASE(of_two_runs_at_once_one_is_refused) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> moment(0.0, 0.04);
    const Scratch whole;
    require_ran(run(hexagon("20", {"--out", "o"}), {whole.path()}));
    const auto expected = left_by(whole / "o");
    int refused = 0;
    for (int k = 0; k < 12; ++k) BOOST_TEST_CONTEXT("round " << k) {
            const Scratch folder;
            if (k % 3 == 1) require_ran(run(hexagon("1", {"--out", "o"}), {folder.path()}));
            const Words force = k % 3 == 1 ? Words{"--force"} : Words{};
            const auto command = hexagon("20", with({"--out", "o"}, force));
            Child first(command, {folder.path()});
            std::this_thread::sleep_for(Child::Seconds(moment(random)));
            Child second(k % 3 == 2 ? problem("rotating_hexagon", {"--restart", "o", "--no-plots"})
                                    : command,
                         {folder.path()});
            const Outcome a = first.finish(), b = second.finish();
            BOOST_TEST((a.status == 0 || b.status == 0), a.err << b.err);
            for (const Outcome& outcome : {a, b})
                if (outcome.status != 0) {
                    BOOST_TEST(outcome.status == 2, outcome.err);
                    ++refused;
                }
            check_same(expected, left_by(folder / "o"));
        }
    BOOST_TEST(refused >= 4);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// A run whose number of particles changes on the way: stopped before or behind a change and restarted, with other
// methods and threads, or killed at any moment, it leaves the same bytes. Its snapshots have other ids from one to the
// next.
#include "problem/ranks.hpp"
#include "problem/short_runs.hpp"
#include "support/effort.hpp"

#include <random>
#include <set>

using namespace spam::test;
using spam::CheckpointReader;
using spam::newest_checkpoint;
namespace fs = std::filesystem;

namespace {

/// A small ellipse: 160 particles, the first of which are split at t = 5, and merged after velocities are reversed.
const Words cloud{"--dimension",        "2",   "--size",  "5",         "--rezone",
                  "--checkpoint-every", "1.7", "--quiet", "--no-plots"};

void run(const Scratch& folder, const Words& more) {
    require_ran(run_in(folder, "gas_cloud", with(cloud, more)));
}
void restart(const Scratch& folder, const Words& more) {
    require_ran(run_in(folder, "gas_cloud", with({"--quiet", "--no-plots"}, more)));
}

std::size_t particles_in(const fs::path& folder) {
    return CheckpointReader(newest_checkpoint(folder).value())
        .numbers("/cases/0/particles/mass")
        .size();
}

}  // namespace

BOOST_AUTO_TEST_CASE(runs_go_on_bit_for_bit_across_a_change) {
    const std::vector<Words> methods{
        {}, {"--integrator", "arkode:DORMAND_PRINCE_7_4_5"}, {"--integrator", "cvode:adams"}};
    for (const Words& method : methods)
        for (const char* threads : {"1", "4"}) BOOST_TEST_CONTEXT(method.size() << threads) {
                const Scratch folder;
                const Words common = with(method, {"--threads", threads, "--output-every", "0.5",
                                                   "--snapshot-every", "2"});
                run(folder, with(common, {"--t-end", "8", "--out", "whole"}));
                BOOST_TEST(particles_in(folder / "whole") > 300U);
                // From before the first change, and from behind some.
                for (const char* end : {"3.4", "6.8"}) {
                    run(folder, with(common, {"--t-end", end, "--out", end}));
                    const std::string from = newest_checkpoint(folder / end).value().string();
                    restart(folder, {"--restart", from, "--t-end", "8", "--out", "rest",
                                     "--threads", threads});
                    check_same(left_by(folder / "whole"), left_by(folder / "rest"));
                    fs::remove_all(folder / "rest");
                }
            }
}

BOOST_AUTO_TEST_CASE(killed_ten_times_around_changes) {
    const Scratch folder;
    const Words common = with(cloud, {"--return", "--time", "1.6", "--threads", "1"});
    const auto begin = std::chrono::steady_clock::now();
    require_ran(run_in(folder, "gas_cloud", with(common, {"--out", "whole"})));
    // Moments are a share of what a run takes here: on a quick machine it would be over before most others.
    const Child::Seconds taken = std::chrono::steady_clock::now() - begin;
    const auto events = contents_of(folder / "whole/events.csv");
    BOOST_TEST(events.find("groups merged") != std::string::npos);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> moment(0.05, 0.6);
    Words command = with(common, {"--out", "killed"});
    int kills = 0;
    for (int tries = 0; kills < 10 && tries < 100; ++tries) {
        Child child(problem("gas_cloud", command), {folder.path()});
        if (command.front() != "--restart")
            child.wait_for(
                [&](const Outcome&) { return fs::exists(folder / "killed/checkpoint_0.h5"); });
        const auto due = std::chrono::steady_clock::now() + moment(random) * taken;
        child.wait_for([&](const Outcome&) { return std::chrono::steady_clock::now() > due; });
        child.send(SIGKILL);
        const Outcome outcome = child.finish();
        command = {"--restart", "killed", "--quiet", "--no-plots", "--threads", "1"};
        if (outcome.signal == SIGKILL) {
            ++kills;
            continue;
        }
        require_ran(outcome);  // went to the end: once more from the beginning
        check_same(left_by(folder / "whole"), left_by(folder / "killed"));
        fs::remove_all(folder / "killed");
        command = with(common, {"--out", "killed"});
    }
    if (fs::exists(folder / "killed")) require_ran(run_in(folder, "gas_cloud", command));
    check_same(left_by(folder / "whole"), left_by(folder / "killed"));
    BOOST_TEST(kills == 10);
}

/// How far ranges of their own reach is found from the state, which no process asks the model of the whole for.
BOOST_AUTO_TEST_CASE(ranges_of_their_own_are_rezoned_alike_on_any_number_of_ranks) {
    if (no_ranks()) return;
    for (const char* ranges : {"density", "ellipses"}) BOOST_TEST_CONTEXT(ranges) {
            const Scratch folder;
            const Words common{"--dimension", "2",       "--size",    "6",   "--rezone",
                               "--ranges",    ranges,    "--t-end",   "1.5", "--largest-volume",
                               "1.5",         "--quiet", "--no-plots"};
            require_ran(run_in(folder, "gas_cloud", with(common, {"--out", "whole"})));
            BOOST_TEST(contents_of(folder / "whole/events.csv").find("merged") !=
                       std::string::npos);
            require_ran(
                run_in(folder, "gas_cloud", with(common, {"--ranks", "2", "--out", "parted"})));
            check_same(files_of(folder / "whole", true), files_of(folder / "parted", true));
        }
}

/// Ids are never used again, so that no reader takes one particle for another.
BOOST_AUTO_TEST_CASE(numbers_of_particles_are_used_once) {
    const Scratch folder;
    run(folder, {"--return", "--time", "1.6", "--threads", "1", "--out", "o"});
    const CheckpointReader last(newest_checkpoint(folder / "o").value());
    const auto id = last.integers("/cases/0/particles/id");
    const std::set<std::int64_t> different(id.begin(), id.end());
    BOOST_TEST(different.size() == id.size());
    BOOST_TEST(*different.rbegin() > 500);
    const auto refused = run_in(folder, "gas_cloud", {"--largest-volume", "3", "--smoke"});
    BOOST_TEST(refused.status == 2);
    BOOST_TEST(refused.err.find("rezone") != std::string::npos, refused.err);
}

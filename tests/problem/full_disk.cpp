// SPDX-License-Identifier: GPL-3.0-or-later
// A disk that fills up and a folder that can no longer be written during a run: one line, status 4, and
// the checkpoints of before go on to the same end.
#include "problem/result_files.hpp"
#include <spam/io/checkpoint_pair.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam::test;
using spam::newest_checkpoint;
using Words = std::vector<std::string>;

namespace {

const std::string hexagon =
    std::string(SPAM_PROBLEMS) +
    "/rotating_hexagon --size 6 --no-plots --transport monaghan --angular-momentum torque_pair "
    "--output-every 1 --snapshot-every 2 --checkpoint-every 2 ";

/// A script with mounts of its own.
Outcome shell(const Scratch& folder, const std::string& script) {
    return Child({"unshare", "--mount", "bash", "-c", script}, {folder.path()})
        .finish(Child::Seconds(120));
}

/// Where mounts are not allowed (an ordinary user, some containers) there is nothing to test here:
/// tests/io/checkpoint_faults injects the same failures into system calls.
bool may_mount() {
    const Scratch folder;
    return shell(folder, "mkdir disk && mount -t tmpfs -o size=100k tmpfs disk").status == 0;
}

void check_failed(const Outcome& outcome, const std::string& says) {
    BOOST_TEST(outcome.status == 4);
    BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1, outcome.err);
    BOOST_TEST(outcome.err.find(says) != std::string::npos, outcome.err);
}

/// From what was saved before the failure, to the end.
void check_goes_on(const Scratch& folder, const std::string& end) {
    const auto newest = newest_checkpoint(folder / "saved");
    BOOST_REQUIRE(newest);
    BOOST_TEST(shell(folder, hexagon + "--quiet --out whole --t-end " + end).status == 0);
    BOOST_TEST(shell(folder, hexagon + "--quiet --out rest --t-end " + end + " --restart " +
                                 newest->string())
                   .status == 0);
    BOOST_TEST(contents_of(folder / "whole/invariants.csv") ==
               contents_of(folder / "rest/invariants.csv"));
    const auto last = collection(folder / "whole/snapshots.pvd").back().second;
    BOOST_TEST((contents_of(folder / ("whole/" + last)) == contents_of(folder / ("rest/" + last))));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_disk_that_fills_up) {
    if (!may_mount()) {
        BOOST_TEST_MESSAGE("no mounts here: not tested");
        return;
    }
    for (const std::string room : {"300k", "500k", "900k"}) BOOST_TEST_CONTEXT(room) {
            const Scratch folder;
            const Outcome outcome = shell(
                folder,
                "mkdir disk saved && mount -t tmpfs -o size=" + room + " tmpfs disk && " + hexagon +
                    "--quiet --t-end 100 --out disk/out; status=$?; cp disk/out/checkpoint* saved; "
                    "exit $status");
            check_failed(outcome, "disk/out");
            for (const auto& entry : std::filesystem::directory_iterator(folder / "saved"))
                BOOST_TEST((entry.path().extension() != ".tmp"), entry.path()
                                                                     << " was left behind");
            check_goes_on(folder, "100");
        }
}

BOOST_AUTO_TEST_CASE(a_folder_that_can_no_longer_be_written) {
    if (!may_mount()) {
        BOOST_TEST_MESSAGE("no mounts here: not tested");
        return;
    }
    const Scratch folder;
    const Outcome outcome = shell(
        folder, hexagon +
                    "--t-end 600 --quiet --out out & run=$!; "
                    "until test -e out/checkpoint_1.h5; do sleep 0.01; done; "
                    "mkdir frozen; mount --bind out frozen && mount -o remount,bind,ro frozen && "
                    "mount --bind frozen out; wait $run; status=$?; "
                    "mkdir saved; cp out/checkpoint* saved; exit $status");
    check_failed(outcome, "out");
    check_goes_on(folder, "600");
}

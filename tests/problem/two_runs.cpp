// SPDX-License-Identifier: GPL-3.0-or-later
// Two runs of which the second begins where the first one ends (water_column): accounts of both, and the
// same bytes wherever they were stopped.
#include "problem/twins.hpp"
#include "support/effort.hpp"

#include <cmath>

using namespace spam::test;
namespace fs = std::filesystem;

namespace {

/// Two runs of a second or two.
const Words small{"--width",
                  "10",
                  "--relaxation-time",
                  "40",
                  "--t-end",
                  "24",
                  "--output-every",
                  "0.8",
                  "--snapshot-every",
                  "8",
                  "--quiet",
                  "--no-plots",
                  "--checkpoint-every",
                  "3.2"};

void check_same_results(const fs::path& one, const fs::path& other) {
    check_same(left_by(one), left_by(other));
    BOOST_TEST(contents_of(one / "result.json") == contents_of(other / "result.json"));
    for (const char* run : {"relaxation", "collapse"})
        BOOST_TEST(contents_of(one / run / "snapshots.pvd") ==
                   contents_of(other / run / "snapshots.pvd"));
}

/// An invariant less what walls, gravity and friction gave, in every row, against the first.
double imbalance(const Csv& rows, const std::string& invariant,
                 const std::vector<std::string>& given) {
    auto balance = rows.column(invariant);
    for (const auto& account : given) {
        const auto values = rows.column(account);
        for (std::size_t k = 0; k < balance.size(); ++k) balance[k] -= values[k];
    }
    double largest = 0.0;
    for (const double value : balance) largest = std::max(largest, std::abs(value - balance[0]));
    return largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(accounts_are_closed_in_both_runs) {
    const Scratch folder;
    require_ran(run_in(folder, "water_column", with(small, {"--out", "out"})));
    for (const std::string name : {"relaxation", "collapse"}) BOOST_TEST_CONTEXT(name) {
            const Csv rows(folder / ("out/" + name + "/invariants.csv"));
            for (const char* account : {"work", "impulse_x", "impulse_y"})
                BOOST_TEST(rows.column(account).front() == 0.0);
            BOOST_TEST(imbalance(rows, "momentum_x", {"impulse_x"}) < 1e-9);
            BOOST_TEST(imbalance(rows, "momentum_y", {"impulse_y"}) < 1e-9);
            BOOST_TEST(imbalance(rows, "energy", {"work"}) < 1e-4 * rows.column("energy")[0]);
        }
    // The wall on the right has gone: what held it pushes the column away.
    const Csv rest(folder / "out/relaxation/invariants.csv"),
        collapse(folder / "out/collapse/invariants.csv");
    BOOST_TEST(std::abs(rest.column("momentum_x").back()) < 0.1);
    BOOST_TEST(collapse.column("momentum_x").back() > 10.0);
    BOOST_TEST(collapse.column("kinetic").front() == rest.column("kinetic").back());
    BOOST_TEST(rest.column("t").back() == 40.0);  // whatever --t-end is
    BOOST_TEST(collapse.column("t").back() == 24.0);
}

BOOST_AUTO_TEST_CASE(killed_in_either_run_it_ends_with_the_same_bytes) {
    const Scratch folder;
    require_ran(run_in(folder, "water_column", with(small, {"--out", "whole"})));
    Words command = with(small, {"--out", "stopped"});
    const fs::path first = folder / "stopped/relaxation/invariants.csv",
                   second = folder / "stopped/collapse/invariants.csv";
    int stops = 0, later = 0;  // in all, and in the second run
    for (const int half = effort(7, 2);;) {
        Child child(problem("water_column", command), {folder.path()});
        if (stops < 2 * half) {
            child.wait_for(
                [&](const Outcome&) { return fs::exists(stops < half ? first : second); });
            const auto due =
                std::chrono::steady_clock::now() + Child::Seconds(0.02 + 0.01 * (stops % half));
            child.wait_for([&](const Outcome&) { return std::chrono::steady_clock::now() > due; });
            child.send(stops % 2 == 0 ? SIGKILL : SIGTERM);
        }
        const Outcome outcome = child.finish();
        if (outcome.signal == 0 && outcome.status != 143) {  // SIGTERM ends a set-up at once
            require_ran(outcome);
            break;
        }
        ++stops;
        if (fs::exists(second)) ++later;
        command = {"--restart", "stopped", "--quiet", "--no-plots"};
    }
    BOOST_TEST(later > 0);
    BOOST_TEST_MESSAGE(stops << " stops, " << later << " of them in the second run");
    check_same_results(folder / "whole", folder / "stopped");
}

/// The end of the first run is off its schedule of checkpoints, and so is that of the second.
BOOST_AUTO_TEST_CASE(a_later_end_is_that_of_the_collapse) {
    const Scratch folder;
    Words odd = small;
    odd.back() = "7";  // checkpoints
    require_ran(run_in(folder, "water_column", with(odd, {"--out", "whole"})));
    Words shorter = odd;
    shorter[5] = "9.6";  // t-end
    require_ran(run_in(folder, "water_column", with(shorter, {"--out", "short"})));
    require_ran(run_in(folder, "water_column",
                       {"--restart", "short", "--t-end", "24", "--out", "rest", "--no-plots"}));
    check_same_results(folder / "whole", folder / "rest");
    require_ran(
        run_in(folder, "water_column", {"--restart", "short", "--t-end", "24", "--no-plots"}));
    check_same_results(folder / "whole", folder / "short");
}

BOOST_AUTO_TEST_CASE(a_column_that_does_not_come_to_rest_is_not_let_go) {
    const Scratch folder;
    const Outcome outcome =
        run_in(folder, "water_column",
               with(small, {"--out", "out", "--guard", "stop", "--limit-energy", "1e-300"}));
    BOOST_TEST(outcome.status == 3);
    BOOST_TEST(fs::exists(folder / "out/relaxation/invariants.csv"));
    BOOST_TEST(!fs::exists(folder / "out/collapse"));
    const Csv rows(folder / "out/relaxation/invariants.csv");
    BOOST_TEST(rows.column("t").back() < 40.0);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints and --restart: a run that was stopped and one that was not are the same, byte for byte.
#include "problem/twins.hpp"
#include "support/effort.hpp"
#include "support/refusal.hpp"

#include <cmath>
#include <random>

using namespace spam::test;
using spam::CheckpointReader;
using spam::newest_checkpoint;
namespace fs = std::filesystem;

namespace {

const Words problems = split(SPAM_PROBLEM_NAMES, ',');

double key(const fs::path& toml, const std::string& name) {
    const std::string text = contents_of(toml);
    const auto at = text.find("\n" + name + " = ");
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + name.size() + 4));
}

/// Intervals that a whole run and its halves share: 16 rows, 4 snapshots, 8 checkpoints in T.
Words intervals(double T) {
    const auto text = [](double x) {
        std::ostringstream out;
        out.precision(17);
        out << x;
        return out.str();
    };
    return {"--output-every", text(T / 16),         "--snapshot-every",
            text(T / 4),      "--checkpoint-every", text(T / 8)};
}

/// One case, no comparison.
Words hexagon(const std::string& size, const Words& more) {
    return with({"--size", size, "--no-plots", "--transport", "monaghan", "--angular-momentum",
                 "torque_pair"},
                more);
}

const Words adaptive{"--integrator", "arkode:DORMAND_PRINCE_7_4_5"};

}  // namespace

/// In long runs: restart_table.cpp restarts each problem where it was stopped, and the last case below goes on to a
/// later end.
BOOST_AUTO_TEST_CASE(every_problem_goes_on_to_a_later_end) {
    if (!long_runs()) return;
    std::size_t twins = 0;
    for (const auto& name : problems) {
        const Scratch folder;
        const Words smoke{"--smoke", "--no-plots"};
        require_ran(run_in(folder, name, with(smoke, {"--out", "probe"})));
        const auto probe = newest_checkpoint(folder / "probe");
        if (!probe) continue;  // an analysis, or a study that goes on from its table
        const double end = CheckpointReader(*probe).numbers("/cases/0/t").at(0);
        const double dt = key(folder / "probe/case.toml", "dt");
        const double T = 16.0 * dt * std::max(1.0, std::round(end / 16.0 / dt));
        ++twins;
        for (const Words& method : {Words{}, adaptive}) BOOST_TEST_CONTEXT(name << method.size()) {
                const Scratch here;
                Words common = with(smoke, method);
                for (const auto& word : intervals(T)) common.push_back(word);
                const auto until = [&](double t, const Words& more) {
                    std::ostringstream words;
                    words.precision(17);
                    words << t;
                    require_ran(run_in(here, name, with({"--t-end", words.str()}, more)));
                };
                until(T, with(common, {"--out", "whole"}));
                until(0.5 * T, with(common, {"--out", "half"}));
                const auto half = newest_checkpoint(here / "half").value().string();
                until(T, {"--restart", half, "--out", "rest", "--threads", "2", "--no-plots"});
                check_same(left_by(here / "whole"), left_by(here / "rest"));
                until(T, {"--restart", half, "--no-plots"});
                check_same(left_by(here / "whole"), left_by(here / "half"));
            }
    }
    BOOST_TEST(twins >= 20u);
}

/// Of more particles, so that threads share the sums and the norms of steps.
BOOST_AUTO_TEST_CASE(the_number_of_threads_may_change) {
    const Scratch folder;
    const Words common =
        hexagon("40", with({"--output-every", "1", "--snapshot-every", "2"}, adaptive));
    const auto run = [&](const Words& more) {
        require_ran(run_in(folder, "rotating_hexagon", more));
    };
    run(with(common, {"--t-end", "4", "--threads", "2", "--out", "whole"}));
    run(with(common, {"--t-end", "2", "--threads", "1", "--out", "half"}));
    run({"--restart", "half", "--t-end", "4", "--threads", "3", "--no-plots"});
    check_same(left_by(folder / "whole"), left_by(folder / "half"));
}

/// The barrier is what makes it so: without one in the uninterrupted run adaptive steps differ.
BOOST_AUTO_TEST_CASE(without_a_barrier_adaptive_steps_are_others) {
    const Scratch folder;
    const Words common =
        hexagon("3", with({"--output-every", "1", "--snapshot-every", "8"}, adaptive));
    const auto run = [&](const Words& more) {
        require_ran(run_in(folder, "rotating_hexagon", with(common, more)));
    };
    run({"--t-end", "16", "--checkpoint-every", "8", "--out", "barrier"});
    run({"--t-end", "16", "--checkpoint-every", "16", "--out", "none"});
    BOOST_TEST((left_by(folder / "barrier") != left_by(folder / "none")));
}

BOOST_AUTO_TEST_CASE(killed_fifty_times_it_ends_with_the_same_bytes) {
    const Scratch folder;
    const Words common = hexagon("6", {"--quiet", "--t-end", "400", "--output-every", "2",
                                       "--snapshot-every", "100", "--checkpoint-every", "2"});
    require_ran(run_in(folder, "rotating_hexagon", with(common, {"--out", "whole"})));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> moment(0.0, 0.03);
    int kills = 0, restarts = 0;
    const int all = effort(50, 5);
    Words command = with(common, {"--out", "killed"});
    while (kills < all) {
        Child child(problem("rotating_hexagon", command), {folder.path()});
        const auto before = newest_checkpoint(folder / "killed");
        if (!before)
            child.wait_for(
                [&](const Outcome&) { return fs::exists(folder / "killed/checkpoint_0.h5"); });
        const auto due = std::chrono::steady_clock::now() + Child::Seconds(0.01 + moment(random));
        const bool alive =
            !child.wait_for([&](const Outcome&) { return std::chrono::steady_clock::now() > due; });
        (void)alive;
        child.send(SIGKILL);
        const Outcome outcome = child.finish();
        if (outcome.signal == SIGKILL) ++kills;
        const auto newest = newest_checkpoint(folder / "killed");
        BOOST_REQUIRE(newest);
        command = {"--restart", newest->string(), "--quiet", "--no-plots"};
        if (outcome.signal == SIGKILL) continue;
        require_ran(outcome);  // went to the end: once more from the beginning
        check_same(left_by(folder / "whole"), left_by(folder / "killed"));
        fs::remove_all(folder / "killed");
        command = with(common, {"--out", "killed"});
        ++restarts;
    }
    if (fs::exists(folder / "killed")) require_ran(run_in(folder, "rotating_hexagon", command));
    check_same(left_by(folder / "whole"), left_by(folder / "killed"));
    BOOST_TEST_MESSAGE(kills << " kills, " << restarts << " ends between");
}

BOOST_AUTO_TEST_CASE(a_signal_leaves_a_checkpoint_that_goes_on) {
    const Words common = hexagon("6", {"--t-end", "1000"});
    const Scratch other;
    require_ran(run_in(other, "rotating_hexagon", with(common, {"--out", "whole"})));
    for (const int signal : {SIGINT, SIGTERM}) {
        const Scratch folder;
        Child child(problem("rotating_hexagon", with(common, {"--out", "out"})), {folder.path()});
        child.wait_for([&](const Outcome&) { return fs::exists(folder / "out/invariants.csv"); });
        child.send(signal);
        BOOST_TEST(child.finish().status == 128 + signal);
        const auto newest = newest_checkpoint(folder / "out");
        BOOST_REQUIRE(newest);
        require_ran(run_in(folder, "rotating_hexagon",
                           {"--restart", newest->string(), "--no-plots", "--t-end", "1000"}));
        // A fixed step in a solid: no barrier leaves a trace.
        BOOST_TEST(contents_of(folder / "out/invariants.csv") ==
                   contents_of(other / "whole/invariants.csv"));
    }
}

BOOST_AUTO_TEST_CASE(a_guard_leaves_a_checkpoint) {
    struct Stop {
        Words arguments;
        std::string says;
    };
    const std::vector<Stop> all{
        {{"--dt", "6"}, "is not positive at t = "},  // beyond what rk4 is stable with
        {with(adaptive, {"--rtol", "1e-14", "--atol", "1e-16", "--min-step", "0.3"}), "step"},
        {with(adaptive, {"--max-steps", "20"}), "too many steps"},
        {{"--guard", "stop", "--limit-energy", "1e-14"}, "energy changed by"},
    };
    for (const Stop& stop : all) BOOST_TEST_CONTEXT(stop.says) {
            const Scratch folder;
            const Words common = hexagon("3", {"--t-end", "400", "--output-every", "1"});
            const Outcome outcome = run_in(folder, "rotating_hexagon",
                                           with(common, with(stop.arguments, {"--out", "o"})));
            BOOST_TEST(outcome.status == 3, outcome.out << outcome.err);
            BOOST_TEST(outcome.err.find(stop.says) != std::string::npos, outcome.err);
            BOOST_REQUIRE(newest_checkpoint(folder / "o"));
            // What stopped it stops it again, and leaves a checkpoint again.
            const Outcome again =
                run_in(folder, "rotating_hexagon", {"--restart", "o", "--no-plots"});
            BOOST_TEST(again.status == 3, again.out << again.err);
        }
    const Scratch folder;
    const Words common = hexagon("3", with({"--t-end", "8", "--checkpoint-every", "2"}, adaptive));
    BOOST_TEST(run_in(folder, "rotating_hexagon", with(common, {"--max-steps", "4", "--out", "o"}))
                   .status == 3);
    require_ran(run_in(folder, "rotating_hexagon",
                       {"--restart", "o", "--max-steps", "1000", "--no-plots"}));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_restarted_is_refused_in_one_line) {
    const Scratch folder;
    require_ran(run_in(folder, "rotating_hexagon", hexagon("3", {"--t-end", "4", "--out", "out"})));
    const auto file = newest_checkpoint(folder / "out").value().string();
    std::string damaged = contents_of(file);
    damaged[damaged.size() / 2] ^= 1;
    folder.write("damaged.h5", damaged);
    folder.write("cut.h5", contents_of(file).substr(0, 1000));
    folder.write("foreign.h5", "no checkpoint at all");
    fs::create_directory(folder / "folder.h5");
    struct Bad {
        std::string program;
        Words arguments, says;
    };
    const std::vector<Bad> all{
        {"rotating_hexagon", {"--restart", "none.h5"}, {"restart", "none.h5"}},
        {"rotating_hexagon", {"--restart", "damaged.h5"}, {"damaged.h5", "damaged"}},
        {"rotating_hexagon", {"--restart", "cut.h5"}, {"cut.h5"}},
        {"rotating_hexagon", {"--restart", "foreign.h5"}, {"foreign.h5", "not a"}},
        {"rotating_hexagon", {"--restart", "folder.h5"}, {"folder.h5"}},
        {"plane_wave", {"--restart", file}, {"rotating_hexagon", "not of plane_wave"}},
        {"rotating_hexagon", {"--restart", file, "--size", "4"}, {"size", "4", "3", "t-end"}},
        {"rotating_hexagon", {"--restart", file, "--dt", "0.05"}, {"dt", "0.05", "0.1"}},
        {"rotating_hexagon", {"--restart", file, "--t-end", "2"}, {"t-end", "2", "4"}},
        {"rotating_hexagon", {"--restart", file, "--force"}, {"force", "folder"}},
        {"rotating_hexagon", {"--restart", file, "--smoke"}, {"smoke"}},
        {"rotating_hexagon", {"--restart", file, "--config", "out/case.toml"}, {"config"}},
        {"rotating_hexagon", {"--restart", file, "--out", "folder.h5/.."}, {"out"}},
    };
    const auto before = folder.listing();
    for (const Bad& bad : all) BOOST_TEST_CONTEXT(bad.arguments[1] << bad.arguments.back()) {
            const Outcome outcome = run_in(folder, bad.program, bad.arguments);
            BOOST_TEST(outcome.status == 2);
            BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
            for (const auto& word : bad.says)
                BOOST_TEST(outcome.err.find(word) != std::string::npos, outcome.err);
            BOOST_TEST((folder.listing() == before));
        }
}

/// By the reader that programs use, and every tenth through a program, as a user would meet it: status 2, one line, no
/// crash, nothing written.
BOOST_AUTO_TEST_CASE(a_thousand_damaged_files_are_refused) {
    const Scratch folder;
    require_ran(run_in(folder, "rotating_hexagon", hexagon("3", {"--t-end", "4", "--out", "out"})));
    const std::string whole = contents_of(newest_checkpoint(folder / "out").value());
    std::mt19937 random(11);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
    std::size_t refused = 0;
    std::size_t tried = 0;
    const std::size_t all = effort(1000U, 60U);
    for (int k = 0; tried < all; ++k) {
        std::string damaged = whole;
        if (k % 3 == 0) damaged[below(damaged.size())] ^= static_cast<char>(1 << below(8));
        if (k % 3 == 1) damaged.resize(below(damaged.size()));
        if (k % 3 == 2) {
            const std::size_t at = below(damaged.size() - 512);
            damaged.replace(at, 512, std::string(512, k % 2 == 0 ? '\0' : '\xff'));
            if (damaged == whole) continue;  // the block held those bytes before
        }
        ++tried;
        folder.write("damaged.h5", damaged);
        if (tried % 10 != 0) {
            const std::string why = refusal([&] { CheckpointReader(folder / "damaged.h5"); });
            const bool said = why != "accepted" && why.find('\n') == std::string::npos;
            BOOST_TEST(said, k << ": " << why);
            refused += said ? 1 : 0;
            continue;
        }
        const Outcome outcome = run_in(folder, "rotating_hexagon", {"--restart", "damaged.h5"});
        const bool one_line = std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1;
        if (outcome.status == 2 && one_line && outcome.out.empty())
            ++refused;
        else
            BOOST_ERROR(k << ": status " << outcome.status << " " << outcome.err);
    }
    BOOST_TEST_MESSAGE(refused << " refused");
    BOOST_TEST(refused == all);
    BOOST_TEST(!fs::exists(folder / "rotating_hexagon-out"));
}

BOOST_AUTO_TEST_CASE(a_restart_may_change_where_the_run_ends) {
    const Scratch folder;
    const Words common = hexagon("3", {"--output-every", "1", "--snapshot-every", "4"});
    const auto run = [&](const Words& words) {
        require_ran(run_in(folder, "rotating_hexagon", words));
    };
    run(with(common, {"--t-end", "8", "--out", "whole"}));
    run(with(common, {"--t-end", "3.7", "--out", "short"}));  // ends between rows
    run({"--restart", newest_checkpoint(folder / "short")->string(), "--t-end", "8", "--no-plots"});
    BOOST_TEST(contents_of(folder / "whole/invariants.csv") ==
               contents_of(folder / "short/invariants.csv"));
    BOOST_TEST(key(folder / "short/case.toml", "t-end") == 8.0);
    // Once more from its end: nothing is left to compute, and nothing changes.
    const auto rows = contents_of(folder / "short/invariants.csv");
    run({"--restart", newest_checkpoint(folder / "short")->string(), "--no-plots"});
    BOOST_TEST(contents_of(folder / "short/invariants.csv") == rows);
}

BOOST_AUTO_TEST_CASE(velocities_that_were_reversed_halfway_have_no_later_end) {
    const Scratch folder;
    require_ran(run_in(folder, "gas_cloud",
                       {"--smoke", "--dimension", "2", "--return", "--t-end", "2", "--no-plots",
                        "--quiet", "--out", "out"}));
    const auto rows = contents_of(folder / "out/invariants.csv");
    const Outcome outcome = run_in(folder, "gas_cloud", {"--restart", "out", "--t-end", "4"});
    BOOST_TEST(outcome.status == 2);
    BOOST_TEST(outcome.err.find("reversed at t = 1") != std::string::npos, outcome.err);
    BOOST_TEST(contents_of(folder / "out/invariants.csv") == rows);
}

/// Bodies are looked for at rows, far enough ahead for the next one.
BOOST_AUTO_TEST_CASE(rows_that_bodies_were_looked_for_at_stay_as_close) {
    const Scratch folder;
    require_ran(run_in(folder, "fragmenting_bar",
                       {"--smoke", "--output-every", "0.1", "--t-end", "1", "--no-plots", "--quiet",
                        "--out", "out"}));
    const auto rows = contents_of(folder / "out/invariants.csv");
    const Words later{"--restart", "out", "--t-end", "2", "--no-plots", "--quiet"};
    const Outcome outcome =
        run_in(folder, "fragmenting_bar", with(later, {"--output-every", "0.5"}));
    BOOST_TEST(outcome.status == 2);
    BOOST_TEST(outcome.err.find("output-every: 0.5") != std::string::npos, outcome.err);
    BOOST_TEST(contents_of(folder / "out/invariants.csv") == rows);
    require_ran(run_in(folder, "fragmenting_bar", with(later, {"--output-every", "0.05"})));
}

/// case.toml names it so.
BOOST_AUTO_TEST_CASE(a_file_of_corners_is_found_from_any_folder) {
    const Scratch folder;
    folder.write("shape.csv", "0,0\n4,0\n4,3\n0,3\n");
    fs::create_directory(folder / "elsewhere");
    require_ran(run_in(folder, "relaxation",
                       {"--smoke", "--no-plots", "--quiet", "--particles", "60", "--outline",
                        "shape.csv", "--t-end", "2", "--out", "out"}));
    require_ran(Child(problem("relaxation", {"--restart", "../out", "--t-end", "4", "--no-plots"}),
                      {folder / "elsewhere"})
                    .finish(Child::Seconds(240)));
    // And by any name that case.toml can hold.
    const std::string odd = "corners\x7f.csv", latin = "corners\xe9.csv";
    for (const std::string& name : {odd, latin}) fs::copy_file(folder / "shape.csv", folder / name);
    const Words shaped{"--smoke", "--no-plots", "--particles", "60", "--t-end", "2", "--outline"};
    require_ran(run_in(folder, "relaxation", with(shaped, {odd, "--out", "odd"})));
    require_ran(run_in(folder, "relaxation", {"--restart", "odd", "--t-end", "3", "--no-plots"}));
    const Outcome refused = run_in(folder, "relaxation", with(shaped, {latin, "--out", "latin"}));
    BOOST_TEST(refused.status == 2);
    BOOST_TEST(refused.err.find("outline: is not UTF-8") != std::string::npos, refused.err);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that a signal or a guard stops off the checkpoint schedule, restarted: the same bytes as runs
// that were left alone. Flows, whose lists are sorted anew at a restart, methods that remember, and
// reflections are where it matters.
#include "problem/twins.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <random>
#include <thread>

using namespace spam::test;
using spam::CheckpointReader;
using spam::newest_checkpoint;
namespace fs = std::filesystem;

namespace {

struct Stopped {
    std::string program;
    Words arguments;         ///< no interval of checkpoints divides the end
    std::size_t steps = 40;  ///< at which the guard stops it
};

const std::vector<Stopped> all{
    {"free_expansion", {"--cells", "14", "--t-end", "20", "--checkpoint-every", "2.9"}},
    {"free_expansion",
     {"--cells", "14", "--t-end", "20", "--checkpoint-every", "2.9", "--integrator",
      "arkode:DORMAND_PRINCE_7_4_5"}},
    {"string_phase", {"--smoke", "--side", "10", "--t-end", "9", "--checkpoint-every", "1.3"}},
    {"rotating_hexagon",
     {"--size", "5", "--transport", "plain", "--closest-approach", "0.97", "--t-end", "25",
      "--checkpoint-every", "3.3"}},
    {"rotating_hexagon",
     {"--size", "5", "--transport", "monaghan", "--integrator", "cvode:adams", "--t-end", "40",
      "--checkpoint-every", "3.3"},
     250},
    {"rotating_hexagon",
     {"--size", "4", "--transport", "monaghan", "--integrator", "gsl:msadams", "--t-end", "40",
      "--checkpoint-every", "3.3"},
     250},
    // Four cases of one session.
    {"rotating_hexagon",
     {"--size", "4", "--t-end", "20.05", "--output-every", "1", "--checkpoint-every", "3.3"}},
};

double seconds_of(const Scratch& folder, const Stopped& one, const Words& arguments) {
    const auto start = std::chrono::steady_clock::now();
    require_ran(run_in(folder, one.program, arguments));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Goes on until nothing stops it any more, and leaves what the whole run left.
void check_goes_on(const Scratch& folder, const Stopped& one, const Words& more) {
    require_ran(run_in(folder, one.program, with({"--restart", "stopped", "--no-plots"}, more)));
    check_same(left_by(folder / "whole"), left_by(folder / "stopped"));
    BOOST_TEST(fs::exists(folder / "stopped/checkpoint_last.h5") ==
               fs::exists(folder / "whole/checkpoint_last.h5"));
    fs::remove_all(folder / "stopped");
}

}  // namespace

BOOST_AUTO_TEST_CASE(whatever_stops_a_run_it_goes_on_bit_for_bit) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> moment(0.1, 0.9);
    int interrupted = 0;
    for (const Stopped& one : all) BOOST_TEST_CONTEXT(one.program << " " << one.arguments.back()) {
            const Scratch folder;
            const Words common = with(one.arguments, {"--no-plots", "--quiet"});
            const double seconds = seconds_of(folder, one, with(common, {"--out", "whole"}));
            const Words command = with(common, {"--out", "stopped"});
            for (const int signal : {SIGTERM, SIGINT}) {
                // Earlier where it came too late, later where nothing had begun yet: how fast a
                // run will be is not known.
                int stopped = 0;
                double after = seconds * moment(random);
                for (int attempt = 0; attempt < 20 && stopped == 0; ++attempt) {
                    Child child(problem(one.program, command), {folder.path()});
                    const auto due = std::chrono::steady_clock::now() + Child::Seconds(after);
                    child.wait_for(
                        [&](const Outcome&) { return std::chrono::steady_clock::now() > due; });
                    child.send(signal);
                    const Outcome outcome = child.finish();
                    if (!fs::exists(folder / "stopped/checkpoint_0.h5")) {
                        fs::remove_all(folder / "stopped");
                        after *= 1.5;
                        continue;
                    }
                    stopped = outcome.status == 128 + signal;
                    after *= 0.7;
                    check_goes_on(folder, one, {});
                }
                interrupted += stopped;
            }
            const Outcome guarded = run_in(
                folder, one.program, with(command, {"--max-steps", std::to_string(one.steps)}));
            BOOST_TEST(guarded.status == 3, guarded.err);
            BOOST_TEST(fs::exists(folder / "stopped/checkpoint_last.h5"));
            check_goes_on(folder, one, {"--max-steps", "1000000"});
        }
    BOOST_TEST(interrupted == 2 * static_cast<int>(all.size()));
}

/// The state in which a run was stopped can be gone on from by name; the program says what differs.
BOOST_AUTO_TEST_CASE(a_state_off_the_schedule_has_a_file_of_its_own) {
    const Scratch folder;
    const Words common{"--size", "3",          "--transport",        "plain", "--t-end",
                       "9.95",   "--no-plots", "--checkpoint-every", "2"};
    require_ran(run_in(folder, "rotating_hexagon", with(common, {"--out", "o"})));
    const CheckpointReader last(folder / "o/checkpoint_last.h5");
    BOOST_TEST(last.numbers("/cases/0/t").at(0) == 9.95);
    const auto scheduled = CheckpointReader(newest_checkpoint(folder / "o").value());
    BOOST_TEST(scheduled.numbers("/cases/0/t").at(0) == 8.0, boost::test_tools::tolerance(1e-12));
    const Outcome on = run_in(folder, "rotating_hexagon",
                              {"--restart", "o/checkpoint_last.h5", "--t-end", "12", "--no-plots"});
    require_ran(on);
    BOOST_TEST(on.out.find("off the checkpoint schedule") != std::string::npos, on.out);
}

/// An end that is no multiple of dt or of the intervals: a later end gives the bytes of a run that
/// always had it.
BOOST_AUTO_TEST_CASE(an_odd_end_leaves_no_trace) {
    const Words adaptive{"--integrator", "arkode:DORMAND_PRINCE_7_4_5"};
    for (const Words& method : {Words{}, adaptive}) {
        const Scratch folder;
        const Words common =
            with({"--size", "4", "--transport", "plain", "--no-plots", "--output-every", "1",
                  "--snapshot-every", "5", "--checkpoint-every", "5"},
                 method);
        require_ran(
            run_in(folder, "rotating_hexagon", with(common, {"--t-end", "20", "--out", "whole"})));
        require_ran(
            run_in(folder, "rotating_hexagon", with(common, {"--t-end", "10.05", "--out", "o"})));
        require_ran(
            run_in(folder, "rotating_hexagon", {"--restart", "o", "--t-end", "20", "--no-plots"}));
        check_same(left_by(folder / "whole"), left_by(folder / "o"));
    }
}

/// Stopped before its first checkpoint, killed before its first step: there is a beginning to go on from.
BOOST_AUTO_TEST_CASE(a_run_can_be_restarted_from_the_first_moment_on) {
    const Scratch folder;
    const Words common{"--size",  "12", "--transport",        "plain", "--no-plots",
                       "--t-end", "30", "--checkpoint-every", "30"};
    require_ran(run_in(folder, "rotating_hexagon", with(common, {"--out", "whole"})));
    Child child(problem("rotating_hexagon", with(common, {"--out", "o"})), {folder.path()});
    child.wait_for([&](const Outcome&) { return fs::exists(folder / "o/checkpoint_0.h5"); });
    child.send(SIGKILL);
    child.finish();
    BOOST_TEST(CheckpointReader(folder / "o/checkpoint_0.h5").integers("/counts").at(0) == 0);
    require_ran(run_in(folder, "rotating_hexagon", {"--restart", "o", "--no-plots"}));
    check_same(left_by(folder / "whole"), left_by(folder / "o"));
}

/// Where a signal finds a folder, it finds a checkpoint in it.
BOOST_AUTO_TEST_CASE(a_folder_is_never_left_without_a_checkpoint) {
    const Words common{"--size", "3", "--transport", "plain", "--no-plots", "--quiet"};
    std::mt19937 random(4);
    std::uniform_real_distribution<double> moment(0.0, 0.02);
    for (int k = 0; k < 25; ++k) {
        const Scratch folder;
        Child child(problem("rotating_hexagon", with(common, {"--out", "o"})), {folder.path()});
        if (k % 2 == 0) child.wait_for([&](const Outcome&) { return fs::exists(folder / "o"); });
        std::this_thread::sleep_for(Child::Seconds(moment(random)));
        child.send(SIGTERM);
        child.finish();
        if (!fs::exists(folder / "o")) continue;
        BOOST_TEST(newest_checkpoint(folder / "o").has_value());
    }
}

/// Ends and intervals belong to a case: those of the first are not those of the others.
BOOST_AUTO_TEST_CASE(each_case_has_its_own_end) {
    const Scratch folder;
    require_ran(run_in(folder, "diffusion_waves",
                       {"--smoke", "--no-plots", "--conductivity", "0.1", "--out", "o"}));
    const auto end_of = [&](const std::string& results) {
        return json_of(folder / (results + "/statistics.json")).at("t_end").get<double>();
    };
    const Words thermal{"--wave", "thermal", "--conductivity", "0.1"}, shear{"--wave", "shear"};
    for (const Words& wave : {thermal, shear}) {
        const std::string label = wave[1];
        require_ran(run_in(folder, "diffusion_waves",
                           with(wave, {"--smoke", "--no-plots", "--out", label})));
        BOOST_TEST(end_of("o/" + label) == end_of(label));
    }
    BOOST_TEST(end_of("o/thermal") != end_of("o/shear"));
    // ... and a restart goes on to each of them.
    require_ran(run_in(folder, "diffusion_waves", {"--restart", "o", "--no-plots", "--out", "p"}));
    check_same(left_by(folder / "o"), left_by(folder / "p"));
}

/// What a run has cost is in no checkpoint, whose bytes are those of the motion, but in its statistics.
BOOST_AUTO_TEST_CASE(what_a_run_has_cost_counts_behind_a_restart) {
    const Scratch folder;
    const Words half{
        "--size", "3",       "--transport", "plain", "--no-plots", "--quiet", "--checkpoint-every",
        "20",     "--t-end", "20",          "--out", "half"};
    const Words go_on{"--restart", "half", "--t-end", "40", "--no-plots", "--quiet", "--out"};
    require_ran(run_in(folder, "rotating_hexagon", half));
    const auto cost = [&](const std::string& results) {
        const auto found = json_of(folder / (results + "/statistics.json"));
        return std::pair{found.at("pair_interactions").get<double>(),
                         found.at("wall_seconds").get<double>()};
    };
    const auto first = cost("half");
    require_ran(run_in(folder, "rotating_hexagon", with(go_on, {"both"})));
    const auto both = cost("both");
    // Where it is gone or damaged, only what comes afterwards counts.
    for (const std::string& text :
         {std::string(), std::string("7"), std::string(100000, '['),
          std::string(R"({"wall_seconds": -1e300, "pair_interactions": {"a": [1]}})")}) {
        folder.write("half/statistics.json", text);
        require_ran(run_in(folder, "rotating_hexagon", with(go_on, {"later", "--force"})));
        BOOST_TEST(std::abs(cost("later").first + first.first - both.first) <= 1.0);
    }
    // A second for each right-hand side: of 800 up to the checkpoint.
    folder.write("half/statistics.json", R"({"rhs_evaluations": 7, "wall_seconds": 7})");
    require_ran(run_in(folder, "rotating_hexagon", with(go_on, {"later", "--force"})));
    BOOST_TEST(std::floor(cost("later").second / 100.0) == 8.0);
    fs::remove(folder / "half/statistics.json");
    require_ran(run_in(folder, "rotating_hexagon", with(go_on, {"later", "--force"})));
    BOOST_TEST(std::abs(cost("later").first + first.first - both.first) <= 1.0);
}

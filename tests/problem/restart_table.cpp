// SPDX-License-Identifier: GPL-3.0-or-later
// Every problem with a fixed and an adaptive method, stopped at a random moment by SIGTERM, SIGINT or a guard
// and restarted: the same files, byte for byte, as of a run that was left alone. One moment for every second
// problem with one method, in long runs for each with both; SPAM_MOMENTS=N in the environment: N moments for each
// problem, method and stop.
#include "problem/short_runs.hpp"
#include "support/effort.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <thread>

using namespace spam::test;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

/// Steps of the shortest of its cases (the folder's own statistics are of all together).
long steps_of(const fs::path& folder) {
    long least = std::numeric_limits<long>::max();
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().filename() == "statistics.json")
            least = std::min(least, json_of(entry.path()).at("steps").get<long>());
    return least;
}

class Table {
  public:
    Table(std::string name, Words arguments) : name_(std::move(name)) {
        common_ = with(std::move(arguments), {"--no-plots", "--quiet"});
        const auto start = Clock::now();
        require_ran(run_in(folder_, name_, with(common_, {"--out", "whole"})));
        seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
        whole_ = files_of(folder_ / "whole");
    }

    /// False where the run had ended before the signal came.
    bool interrupt(int signal, double part, bool elsewhere) {
        for (int attempt = 1; attempt < 10; ++attempt) {
            fs::remove_all(folder_ / "stopped");
            Child child(problem(name_, with(common_, {"--out", "stopped"})), {folder_.path()});
            child.wait_for(
                [&](const Outcome&) { return fs::exists(folder_ / "stopped/checkpoint_0.h5"); });
            std::this_thread::sleep_for(Child::Seconds(part * seconds_ / attempt));
            child.send(signal);
            if (child.finish(Child::Seconds(240)).status == 128 + signal) {
                check_goes_on({}, elsewhere);
                return true;
            }
        }
        return false;
    }

    void guard(double part, bool elsewhere) {
        fs::remove_all(folder_ / "stopped");
        const auto most =
            std::max(1L, std::lround(part * static_cast<double>(steps_of(folder_ / "whole"))));
        const auto outcome =
            run_in(folder_, name_,
                   with(common_, {"--out", "stopped", "--max-steps", std::to_string(most)}));
        BOOST_TEST(outcome.status == 3, outcome.err);
        check_goes_on({"--max-steps", "100000000"}, elsewhere);
    }

  private:
    /// In place, or in another folder and on another number of threads, where files that a problem itself writes at
    /// snapshots (free_expansion's fields) begin later.
    void check_goes_on(Words more, bool elsewhere) {
        if (elsewhere) {
            fs::remove_all(folder_ / "rest");
            more = with(more, {"--out", "rest", "--threads", "2"});
        }
        require_ran(
            run_in(folder_, name_, with({"--restart", "stopped", "--no-plots", "--quiet"}, more)));
        if (!elsewhere) check_same(whole_, files_of(folder_ / "stopped"));
        check_same(left_by(folder_ / "whole"), left_by(folder_ / (elsewhere ? "rest" : "stopped")));
    }

    std::string name_;
    Words common_;
    Scratch folder_;
    double seconds_ = 0.0;
    std::map<std::string, std::string> whole_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(every_problem_is_in_the_table) {
    for (const auto& name : split(SPAM_PROBLEM_NAMES, ','))
        BOOST_TEST(short_runs.contains(name) + without_checkpoints.contains(name) == 1, name);
    for (const auto& name : without_checkpoints) {
        const Outcome refused = run(problem(name, {"--smoke", "--no-plots", "--restart", "x.h5"}));
        BOOST_TEST(refused.status == 2, name << refused.err);
    }
}

BOOST_AUTO_TEST_CASE(whatever_stops_a_problem_it_leaves_the_same_files) {
    const char* asked = std::getenv("SPAM_MOMENTS");
    const int moments = asked == nullptr ? 0 : std::stoi(asked);
    std::mt19937 random(20261122);
    std::uniform_real_distribution<double> moment(0.04, 0.93);
    const std::vector<std::string> stops{"SIGTERM", "SIGINT", "guard"};
    std::size_t cell = 0;
    int restarts = 0;
    for (const auto& [name, arguments] : all_short_runs())
        for (const char* method : {"rk4", "arkode:DORMAND_PRINCE_7_4_5"}) {
            ++cell;
            if (moments == 0 && !long_runs() && (cell + cell / 4) % 4 != 0) continue;
            Table table(name, with(arguments, {"--integrator", method}));
            for (std::size_t stop = 0; stop < stops.size(); ++stop) {
                if (moments == 0 && (cell + cell / 3) % 3 != stop) continue;
                for (int k = 0; k < std::max(1, moments); ++k)
                    BOOST_TEST_CONTEXT(name << " " << method << " " << stops[stop]) {
                        const double part = moment(random);
                        const bool elsewhere = restarts % 2 == 1;
                        if (stops[stop] == "guard")
                            table.guard(part, elsewhere);
                        else
                            BOOST_TEST(table.interrupt(stops[stop] == "SIGTERM" ? SIGTERM : SIGINT,
                                                       part, elsewhere));
                        ++restarts;
                    }
            }
            if (moments > 0)
                std::cout << name << " " << method << ": " << 3 * moments << " restarts\n"
                          << std::flush;
        }
    std::cout << restarts << " restarts\n";
    BOOST_TEST(restarts > 0);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Every problem with a fixed and an adaptive method, stopped at a random moment by SIGTERM, SIGINT or a guard
// and restarted: the same files, byte for byte, as of a run that was left alone. One moment for each problem
// and method; SPAM_MOMENTS=N in the environment: N moments for each problem, method and stop.
#include "problem/twins.hpp"
#include "support/effort.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <set>
#include <thread>

using namespace spam::test;
namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

/// A second or less each; no interval of checkpoints divides the end.
const std::map<std::string, Words> runs{
    {"ball_plate",
     {"--radius", "3", "--columns", "24", "--rows", "4", "--t-end", "30", "--checkpoint-every",
      "3.3"}},
    {"cantilever", {"--layers", "4", "--t-end", "0.1", "--checkpoint-every", "0.009"}},
    {"cavity", {"--cells", "12", "--t-end", "120", "--checkpoint-every", "17"}},
    {"cavitating_drop", {"--radius", "8", "--rate", "0.3", "--checkpoint-every", "0.93"}},
    {"collapse", {"--radius", "2.5", "--checkpoint-every", "0.0513"}},
    {"colliding_rings",
     {"--radius", "6", "--inner-radius", "3.5", "--t-end", "80", "--checkpoint-every", "7"}},
    {"couette", {"--cells", "16", "--t-end", "120", "--checkpoint-every", "17"}},
    {"counter_rotating", {"--size", "4", "--turns", "0.5", "--checkpoint-every", "9"}},
    {"crushed_sheet",
     {"--columns", "16", "--width", "6", "--t-end", "150", "--checkpoint-every", "17"}},
    {"diffusion_waves", {"--cells", "16", "--t-end", "20", "--checkpoint-every", "3"}},
    {"drop", {"--cells", "12", "--t-end", "80", "--checkpoint-every", "7"}},
    {"fragmenting_bar",
     {"--columns", "5", "--rows", "24", "--projectile", "3", "--offset", "3", "--t-end", "80",
      "--checkpoint-every", "7"}},
    {"free_expansion", {"--cells", "24", "--t-end", "60", "--checkpoint-every", "7"}},
    {"gas_cloud",
     {"--dimension", "2", "--size", "5", "--return", "--time", "2", "--ranges", "density",
      "--checkpoint-every", "3.1"}},
    {"isomorphism", {"--cells", "10", "--t-end", "40", "--checkpoint-every", "4"}},
    {"lattice_stability",
     {"--cells", "8", "--block", "8", "--range", "2.5", "--t-end", "20", "--checkpoint-every",
      "2.3"}},
    {"md_fields",
     {"--cells", "13", "--radius", "4", "--offset", "3", "--t-end", "1.5", "--output-every", "0.05",
      "--checkpoint-every", "0.23"}},
    {"mesh_modes", {"--elements", "6", "--t-end", "30", "--checkpoint-every", "7"}},
    {"phase_separation",
     {"--cells", "24", "--disorder", "0.2", "--t-end", "40", "--checkpoint-every", "3.3"}},
    {"pierced_bar",
     {"--columns", "5", "--rows", "24", "--projectile", "3", "--t-end", "40", "--checkpoint-every",
      "3.3"}},
    {"plane_wave",
     {"--cells", "10", "--t-end", "50", "--perturb", "1e-6", "--checkpoint-every", "7"}},
    {"polytrope",
     {"--particles", "80", "--relaxation-time", "2", "--t-end", "3", "--checkpoint-every", "0.7"}},
    {"poiseuille", {"--cells", "16", "--t-end", "120", "--checkpoint-every", "17"}},
    {"rayleigh_benard", {"--height", "10", "--t-end", "120", "--checkpoint-every", "17"}},
    {"reaction_front",
     {"--width", "3", "--rows", "4", "--heat", "0.5", "--t-end", "3", "--checkpoint-every", "0.7"}},
    {"relaxation", {"--particles", "120", "--t-end", "20", "--checkpoint-every", "1.7"}},
    {"rotating_body",
     {"--size", "4", "--turns", "0.2", "--angular-momentum", "torque_pair", "--transport",
      "average", "--checkpoint-every", "5.3"}},
    {"rotating_disk", {"--radius", "9", "--t-end", "60", "--checkpoint-every", "7"}},
    {"rotating_hexagon", {"--size", "5", "--t-end", "250", "--checkpoint-every", "23"}},
    {"plastic_block", {"--checkpoint-every", "1.7"}},
    {"sheared_square", {"--cells", "12", "--checkpoint-every", "7"}},
    {"shock_tube", {"--cells", "200", "--t-end", "0.1", "--single", "--checkpoint-every", "0.007"}},
    {"blast", {"--cells", "24", "--single", "--t-end", "0.04", "--checkpoint-every", "0.0053"}},
    {"string_phase", {"--t-end", "50", "--checkpoint-every", "7"}},
    {"taylor_green", {"--cells", "14", "--t-end", "120", "--checkpoint-every", "17"}},
    {"taylor_bar", {"--particles-per-radius", "2", "--t-end", "20", "--checkpoint-every", "1.7"}},
    {"tensile_instability", {"--cells", "8", "--t-end", "15", "--checkpoint-every", "1.7"}},
    {"torsion", {"--columns", "3", "--periods", "0.7", "--checkpoint-every", "7"}},
    {"tension_test",
     {"--columns", "16", "--rows", "6", "--load-rate", "4e-5", "--t-end", "120",
      "--checkpoint-every", "17"}},
    {"water_column",
     {"--model", "both", "--width", "6", "--t-end", "10", "--checkpoint-every", "1.7"}},
};
/// Analyses, and studies that go on from their table.
const std::set<std::string> without_checkpoints{
    "algorithm_sweep", "integrator_accuracy",    "invariant_drift", "kernels",   "loaded_bar",
    "lyapunov",        "material_vectors_study", "thousand_turns",  "stability", "turns_survived"};

/// Tables, configurations and the result, by their names.
std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".csv" || extension == ".vtp" || extension == ".vti" ||
            extension == ".pvd" || entry.path().filename() == "result.json")
            all[entry.path().lexically_relative(folder).string()] = contents_of(entry.path());
    }
    return all;
}

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
    bool interrupt(int signal, double part) {
        for (int attempt = 1; attempt < 10; ++attempt) {
            fs::remove_all(folder_ / "stopped");
            Child child(problem(name_, with(common_, {"--out", "stopped"})), {folder_.path()});
            child.wait_for(
                [&](const Outcome&) { return fs::exists(folder_ / "stopped/checkpoint_0.h5"); });
            std::this_thread::sleep_for(Child::Seconds(part * seconds_ / attempt));
            child.send(signal);
            if (child.finish(Child::Seconds(240)).status == 128 + signal) {
                check_goes_on({});
                return true;
            }
        }
        return false;
    }

    void guard(double part) {
        fs::remove_all(folder_ / "stopped");
        const auto most =
            std::max(1L, std::lround(part * static_cast<double>(steps_of(folder_ / "whole"))));
        const auto outcome =
            run_in(folder_, name_,
                   with(common_, {"--out", "stopped", "--max-steps", std::to_string(most)}));
        BOOST_TEST(outcome.status == 3, outcome.err);
        check_goes_on({"--max-steps", "100000000"});
    }

  private:
    void check_goes_on(const Words& more) {
        require_ran(
            run_in(folder_, name_, with({"--restart", "stopped", "--no-plots", "--quiet"}, more)));
        check_same(whole_, files_of(folder_ / "stopped"));
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
        BOOST_TEST(runs.contains(name) + without_checkpoints.contains(name) == 1, name);
}

BOOST_AUTO_TEST_CASE(whatever_stops_a_problem_it_leaves_the_same_files) {
    const char* asked = std::getenv("SPAM_MOMENTS");
    const int moments = asked == nullptr ? 0 : std::stoi(asked);
    std::mt19937 random(20261122);
    std::uniform_real_distribution<double> moment(0.04, 0.93);
    const std::vector<std::string> stops{"SIGTERM", "SIGINT", "guard"};
    std::size_t cell = 0;
    int restarts = 0;
    for (const auto& [name, arguments] : runs)
        for (const char* method : {"rk4", "arkode:DORMAND_PRINCE_7_4_5"}) {
            ++cell;
            // Where everything takes ten times as long, one of the two methods.
            if (moments == 0 && effort(false, (cell + cell / 2) % 2 == 0)) continue;
            Table table(name, with(arguments, {"--integrator", method}));
            for (std::size_t stop = 0; stop < stops.size(); ++stop) {
                if (moments == 0 && (cell + cell / 3) % 3 != stop) continue;
                for (int k = 0; k < std::max(1, moments); ++k)
                    BOOST_TEST_CONTEXT(name << " " << method << " " << stops[stop]) {
                        const double part = moment(random);
                        if (stops[stop] == "guard")
                            table.guard(part);
                        else
                            BOOST_TEST(
                                table.interrupt(stops[stop] == "SIGTERM" ? SIGTERM : SIGINT, part));
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

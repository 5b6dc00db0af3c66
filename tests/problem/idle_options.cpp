// SPDX-License-Identifier: GPL-3.0-or-later
// No option may silently do nothing: every option of every problem, given another legal value, is
// refused, or changes the results and is part of case.toml. Words in a banner are no results.
#include "problem/result_files.hpp"
#include <spam/io/checkpoint_file.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

/// How to run, not what to compute.
const std::set<std::string> no_part_of_the_case{
    "config",   "out",     "force", "dry-run", "smoke",   "quiet", "help",
    "no-plots", "threads", "jobs",  "version", "restart", "movie"};

/// What must happen for an option to show: given beside it, and to the run it is compared with.
const std::map<std::string, Words> beside{
    {"left", {"--right", "mirror"}},
    {"right", {"--left", "mirror"}},
    {"balance", {"--t-end", "80"}},  // the bar has broken
    {"guard", {"--limit-energy", "1e-300"}},
    {"gauss-singular", {"--t-end", "40"}},  // the constraint sets in at 14 and is singular at 36
};

/// A value that is the default nowhere.
const std::map<std::string, std::string> another_value{
    {"t-end", "7.3"},
    {"output-every", "0.9"},
    {"snapshot-every", "1.1"},
    {"integrator", "arkode:DORMAND_PRINCE_7_4_5"},
    {"dt", "0.02"},
    {"rtol", "1e-6"},
    {"atol", "1e-7"},
    {"guard", "stop"},
    {"limit-momentum", "1e-300"},
    {"limit-angular-momentum", "1e-300"},
    {"limit-energy", "1e-300"},
    {"kernel", "w6"},
    {"range", "2.7"},
    {"density", "summed"},
    {"transport", "average"},
    {"mean-density", "geometric"},
    {"angular-momentum", "torque_particle"},
    {"balance", "global"},
    {"gauss-singular", "stop"},
    {"viscosity", "0.7"},
    {"closest-approach", "0.9999"},
    {"size", "4"},
    {"speed", "0.2"},
    {"turns", "1.5"},
    {"columns", "5"},
    {"rows", "14"},
    {"projectile", "3"},
    {"offset", "1.5"},
    {"polarization", "longitudinal"},
    {"cells", "14"},
    {"amplitude", "0.1"},
    {"block", "4"},
    {"shape", "hexagon"},
    {"radius", "8"},
    {"damping", "0.4"},
    {"model", "md"},
    {"figure", "5"},
    {"formulation", "total_lagrangian"},
    {"penalty", "0.3"},
    {"shear", "0.03"},
    {"stress", "0.015"},
    {"checkpoint-every", "1e6"},
    {"atol-position", "1e-4"},
    {"atol-velocity", "1e-4"},
    {"atol-density", "1e-4"},
    {"atol-stress", "1e-4"},
    {"atol-energy", "1e-4"},
    {"controller", "i"},
    {"safety", "0.6"},
    {"min-step", "1e3"},
    {"max-step", "0.031"},
    {"initial-step", "0.0011"},
    {"max-steps", "2"},
    {"problem", "wave"},
    {"methods", "rk4,arkode:CASH_KARP_6_4_5"},
    {"steps", "fixed"},
    {"calls", "3000"},
    {"tightest", "1e-4"},
    {"periods", "3"},
    {"calls-per-time", "17"},
    {"smallest-range", "2"},
    {"largest-range", "5"},
    {"ranges", "4"},
    {"family", "4"},
    {"dimension", "1"},
    {"ranges", "density"},
    {"particles", "196"},
    {"seed", "9"},
    {"law", "lucy"},
    {"perturbation", "1e-7"},
    {"wave", "thermal"},
    {"temperature", "1.3"},
    {"conductivity", "0.7"},
    {"equation-of-state", "van_der_waals"},
    {"attraction", "0.3"},
    {"excluded", "0.3"},
    {"side", "19"},
    {"rho0", "0.9"},
    {"core", "0.2"},
    {"core-range", "0.9"},
    {"contact", "0.15"},
    {"contact-range", "0.95"},
    {"inner-radius", "4"},
    {"length", "0.3"},
    {"thickness", "0.03"},
    {"layers", "5"},
    {"young", "1e6"},
    {"poisson", "0.3"},
    {"yield-stress", "0.03"},
    {"hardening", "0.02"},
    {"surface-tension", "0.2"},
    {"disorder", "0.2"},
    {"lattice", "square"},
    {"potential", "both"},
    {"strength", "0.2"},
    {"misfit", "0.98"},
    {"lobes", "5"},
    {"depth", "0.3"},
    {"outline", "nowhere.csv"},
    {"start", "lattice"},
    {"walls", "mirror"},
    {"reynolds", "30"},
    {"gamma", "1.6"},
    {"friction", "gradients"},
    {"width", "9"},
    {"aspect", "2"},
    {"cavitation", "0.02"},
    {"gravity", "0.3"},
    {"relaxation-time", "6.4"},
    {"shifting", "0.7"},
    {"left", "mirror"},
    {"right", "mirror"},
    {"bottom", "mirror@1.5"},
    {"top", "mirror@0.5"},
    {"height", "12"},
    {"roll", "0.1"},
    {"elements", "3"},
    {"hourglass-viscosity", "0.3"},
    {"hourglass-stiffness", "0.2"},
    {"rayleigh", "2000"},
    {"taper", "0.2"},
    {"load-rate", "1e-3"},
    {"failure-strain", "0.05"},
    {"spin", "0.02"},
    {"yield", "after"},
    {"yield-width", "0.2"},
    {"particles-per-radius", "3"},
    {"gap", "1.3"},
    {"travel", "15"},
    {"ends", "held"},
};

/// Cases of problems that leave different options without effect.
const std::vector<std::pair<std::string, Words>> cases{
    {"rotating_hexagon", {}},
    {"rotating_hexagon", {"--model", "md"}},
    {"rotating_hexagon", {"--formulation", "total_lagrangian"}},
    {"rotating_hexagon", {"--formulation", "material_vectors"}},
    {"rotating_hexagon", {"--figure", "6"}},
    {"rotating_hexagon", {"--angular-momentum", "gauss", "--transport", "monaghan"}},
    {"rotating_hexagon", {"--integrator", "arkode:BOGACKI_SHAMPINE_4_2_3"}},
    {"rotating_disk", {"--model", "md"}},
    {"rotating_disk", {"--model", "spam"}},
    {"plane_wave", {}},
    {"plane_wave", {"--polarization", "transverse"}},
    {"plane_wave", {"--compare-sizes", "--cells", "16", "--closest-approach", "0.5"}},
    {"tensile_instability", {}},
    {"tensile_instability", {"--stress", "0.01", "--speed", "0.01"}},
    {"stability", {}},
    {"stability", {"--transport", "monaghan"}},
    {"sheared_square", {"--cells", "10"}},
    {"counter_rotating", {}},
    {"counter_rotating", {"--angular-momentum", "gauss"}},
    {"fragmenting_bar", {}},
    {"algorithm_sweep", {"--size", "1"}},
    {"integrator_accuracy", {}},
    {"invariant_drift", {}},
    {"kernels", {}},
    {"free_expansion", {}},
    {"free_expansion", {"--dimension", "1"}},
    {"free_expansion", {"--compare"}},
    {"isomorphism", {}},
    {"diffusion_waves", {"--density", "continuity"}},
    {"diffusion_waves",
     {"--wave", "shear", "--equation-of-state", "van_der_waals", "--density", "continuity"}},
    {"turns_survived", {}},
    {"string_phase", {}},
    {"string_phase", {"--core", "0"}},
    {"drop", {}},
    {"mesh_modes", {}},
    {"drop", {"--core", "0.1", "--disorder", "0.1"}},
    {"lattice_stability", {}},
    {"lattice_stability", {"--potential", "both"}},
    {"lattice_stability", {"--potential", "density"}},
    {"relaxation", {}},
    {"couette", {}},
    {"poiseuille", {}},
    {"taylor_green", {}},
    {"taylor_green", {"--disorder", "0.1"}},
    {"taylor_green", {"--transport", "plain"}},
    {"colliding_rings", {"--formulation", "total_lagrangian"}},
    {"colliding_rings", {"--formulation", "updated"}},
    {"cantilever", {"--formulation", "total_lagrangian"}},
    {"cantilever", {"--formulation", "updated"}},
    {"crushed_sheet", {}},
    {"cavity", {"--density", "continuity"}},
    {"shock_tube", {}},
    {"rayleigh_benard", {"--density", "continuity"}},
    {"water_column", {}},
    {"plastic_block", {}},
    {"plastic_block", {"--formulation", "total_lagrangian"}},
    {"plastic_block", {"--yield", "smooth"}},
    {"taylor_bar", {"--t-end", "0.5"}},
    {"water_column", {"--core", "0"}},
    {"tension_test", {}},
    {"tension_test", {"--model", "pair_md"}},
    {"tension_test", {"--model", "embedded_atom"}},
    {"ball_plate", {}},
    {"ball_plate", {"--model", "pair_md"}},
    {"ball_plate", {"--model", "embedded_atom", "--contact", "0.1"}},
};

std::vector<std::string> options_of(const std::string& program) {
    std::vector<std::string> names;
    for (const auto& line : split(run(problem(program, {"--help"})).out, '\n')) {
        const auto at = line.find_first_not_of(' ');
        if (at == std::string::npos || at > 8 || line.compare(at, 2, "--") != 0) continue;
        names.push_back(line.substr(at + 2, line.find_first_of(" ,", at) - at - 2));
    }
    return names;
}

struct Ran {
    Outcome outcome;
    std::string case_toml;
    std::map<std::string, std::string> results;
};

/// Tables of studies end with the seconds of a run.
std::string without_seconds(const std::string& table) {
    const auto header = table.find(",seconds\n");
    if (header == std::string::npos || header > table.find('\n')) return table;
    std::string text;
    for (const auto& line : split(table, '\n')) text += line.substr(0, line.rfind(',')) + '\n';
    return text;
}

/// Of the cases in a checkpoint.
std::string times_in(const std::filesystem::path& file) {
    const spam::CheckpointReader checkpoint(file);
    std::string times;
    for (int k = 0; checkpoint.has("/cases/" + std::to_string(k) + "/t"); ++k)
        times +=
            std::to_string(checkpoint.numbers("/cases/" + std::to_string(k) + "/t").at(0)) + " ";
    return times;
}

Ran run_with(const std::string& program, const Words& arguments) {
    const Scratch folder;
    Words words{"--smoke", "--no-plots", "--out", "out"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    Ran ran;
    ran.outcome = Child(problem(program, words), {folder.path()}).finish(Child::Seconds(300));
    if (!std::filesystem::exists(folder / "out/case.toml")) return ran;
    ran.case_toml = contents_of(folder / "out/case.toml");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out")) {
        const auto name = entry.path().filename();
        if (name.extension() == ".h5") ran.results[name] = times_in(entry.path());
        const bool table = name.extension() == ".csv" && name != "references.csv";
        if (table || name == "result.json" || name == "snapshots.pvd")
            ran.results[entry.path().lexically_relative(folder / "out")] =
                without_seconds(contents_of(entry.path()));
    }
    return ran;
}

/// Runs to compare with, by their words.
class Comparisons {
  public:
    explicit Comparisons(std::string program) : program_(std::move(program)) {}
    const Ran& with(const Words& words) {
        const auto known = ran_.find(words);
        return known != ran_.end() ? known->second
                                   : ran_.emplace(words, run_with(program_, words)).first->second;
    }

  private:
    std::string program_;
    std::map<Words, Ran> ran_;
};

void check_option(const std::string& program, Words words, Comparisons& comparisons,
                  const std::string& option) {
    if (beside.contains(option))
        words.insert(words.end(), beside.at(option).begin(), beside.at(option).end());
    const Words base = words;
    words.push_back("--" + option);
    if (another_value.contains(option)) words.push_back(another_value.at(option));
    const Ran ran = run_with(program, words);
    std::string shown = program;
    for (const auto& word : words) shown.append(" ").append(word);
    BOOST_TEST_CONTEXT(shown) {
        if (ran.outcome.status == 2) {
            BOOST_TEST(ran.outcome.err.find(option) != std::string::npos, ran.outcome.err);
            return;
        }
        BOOST_TEST(ran.case_toml.find("\n" + option + " = ") != std::string::npos);
        BOOST_TEST((ran.results != comparisons.with(base).results), "it does nothing");
    }
}

/// ctest runs every fifth case apart, so that they share the processors.
bool is_mine(std::size_t number) {
    const char* part = std::getenv("SPAM_FIFTH");
    return part == nullptr || number % 5 == std::strtoul(part, nullptr, 10);
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_option_has_an_effect_or_is_refused) {
    std::size_t tried = 0;
    for (std::size_t number = 0; number < cases.size(); ++number) {
        const auto& [program, base] = cases[number];
        if (!is_mine(number)) continue;
#if SPAM_SANITIZED
        if (program != "rotating_hexagon") continue;  // thousands of runs, ten times slower
#endif
        Comparisons comparisons(program);
        const Ran& before = comparisons.with(base);
        BOOST_REQUIRE_MESSAGE(before.outcome.status == 0, program << before.outcome.err);
        for (const auto& option : options_of(program)) {
            const bool given = std::find(base.begin(), base.end(), "--" + option) != base.end();
            if (given || no_part_of_the_case.contains(option)) continue;
            check_option(program, base, comparisons, option);
            ++tried;
        }
    }
#if !SPAM_SANITIZED
    BOOST_TEST(tried > 100u);
#endif
}

BOOST_AUTO_TEST_CASE(every_problem_has_a_case) {
    std::set<std::string> problems;
    for (const auto& [program, base] : cases) problems.insert(program);
    for (const auto& program : split(SPAM_PROBLEM_NAMES, ','))
        BOOST_TEST(problems.contains(program), program << " has no case here");
}

// SPDX-License-Identifier: GPL-3.0-or-later
// What holds for every problem executable, whatever it computes: the contract of its options, its
// results and its exit status, run short.
#include "problem/refused.hpp"
#include "problem/result_files.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>
#include <fnmatch.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

const Words problems = split(SPAM_PROBLEM_NAMES, ',');

Outcome run_in(const Scratch& folder, const std::string& name, const Words& arguments) {
    return Child(problem(name, arguments), {folder.path()}).finish(Child::Seconds(240));
}

/// Every table of invariants below a result folder, by its place there; of a problem without one, what
/// it found.
std::map<std::string, std::string> invariants(const std::filesystem::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().filename() == "invariants.csv")
            all[entry.path().lexically_relative(folder).string()] = contents_of(entry.path());
    if (all.empty()) all["result.json"] = contents_of(folder / "result.json");
    return all;
}

/// Problems whose results are times, which no second run has.
const std::set<std::string> measures_time{"parallel_efficiency"};

void check_checks(const nlohmann::json& results) {
    std::size_t claimed = 0;
    std::set<std::string> names;
    for (const auto& item : results) {
        BOOST_TEST(names.insert(item.at("name")).second, "two checks are " << item.at("name"));
        BOOST_TEST(item.at("value").is_number(), item.at("name") << " is no number");
        BOOST_TEST(item.at("holds").get<bool>(), item.at("name") << " does not hold");
        if (!item.at("expected").is_null()) ++claimed;
    }
    BOOST_TEST(claimed > 0u, "a problem that claims nothing cannot fail");
}

/// Tables of the whole run, all of them named in a page: `LABEL` there stands for what a case is called.
void check_tables(const std::filesystem::path& out) {
    const std::string page = contents_of(std::string(SPAM_SOURCE) + "/src/docs/results.md");
    Words known = split(page, '`');
    for (auto& word : known)
        if (const auto at = word.find("LABEL"); at != std::string::npos)
            word = word.substr(0, at) + "*" + word.substr(at + 5);
    const auto is_known = [&](const std::string& name) {
        return std::any_of(known.begin(), known.end(), [&](const std::string& word) {
            return word.ends_with(".csv") && fnmatch(word.c_str(), name.c_str(), 0) == 0;
        });
    };
    for (const auto& entry : std::filesystem::directory_iterator(out))
        if (const auto name = entry.path().filename(); name.extension() == ".csv")
            BOOST_TEST(is_known(name), "the page of the result folder says nothing of " << name);
}

void check_pictures(const std::filesystem::path& out) {
    std::size_t scripts = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out)) {
        BOOST_TEST((entry.path().extension() != ".err"), entry.path() << ": gnuplot complains");
        if (entry.path().extension() != ".gp") continue;
        ++scripts;
        auto png = entry.path();
        BOOST_TEST(
            (!have_gnuplot() || std::filesystem::file_size(png.replace_extension(".png")) > 2000u));
    }
    BOOST_TEST(scripts > 0u);
}

}  // namespace

BOOST_AUTO_TEST_CASE(there_are_problems) { BOOST_TEST(problems.size() >= 3u); }

BOOST_AUTO_TEST_CASE(a_smoke_run_holds_and_its_case_runs_again) {
    Spread due(6, 1000);  // of second runs
    for (const auto& name : problems) BOOST_TEST_CONTEXT(name) {
            const Scratch folder;
            const Outcome outcome = run_in(folder, name, {"--smoke", "--out", "out"});
            BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
            if (have_gnuplot()) BOOST_TEST(outcome.err == "");
            check_checks(json_of(folder / "out/result.json"));
            BOOST_TEST((json_of(folder / "out/statistics.json")["problem"] == name));
            BOOST_TEST(contents_of(folder / "out/run.log").find(name) == 0u);
            check_pictures(folder / "out");
            check_tables(folder / "out");

            if (!due.next()) continue;
            const Outcome again =
                run_in(folder, name, {"--config", "out/case.toml", "--out", "again", "--no-plots"});
            BOOST_TEST(again.status == 0, again.out << again.err);
            const auto first = invariants(folder / "out");
            BOOST_TEST(!first.empty());
            if (!measures_time.contains(name))
                BOOST_TEST((first == invariants(folder / "again")), "case.toml is another case");
        }
}

BOOST_AUTO_TEST_CASE(a_dry_run_says_what_it_would_do_and_does_nothing) {
    for (const auto& name : problems) BOOST_TEST_CONTEXT(name) {
            const Scratch folder;
            const Outcome outcome = run_in(folder, name, {"--dry-run"});
            BOOST_TEST(outcome.status == 0);
            for (const std::string words :
                 {name.c_str(), "units       ", "particles", "integrator", "dry run"})
                BOOST_TEST(outcome.out.find(words) != std::string::npos, "no '" << words << "'");
            BOOST_TEST(folder.listing().empty());
        }
}

/// Of times, whose options every problem has.
BOOST_AUTO_TEST_CASE(help_says_the_units) {
    for (const auto& name : problems) BOOST_TEST_CONTEXT(name) {
            const std::string help = run(problem(name, {"--help"})).out;
            const std::size_t end = help.find("time at which the run ends, ");
            BOOST_REQUIRE(end != std::string::npos);
            const std::size_t last = help.rfind("Units: ");
            BOOST_REQUIRE(last != std::string::npos);
            const bool reduced = help.compare(last, 15, "Units: reduced:") == 0;
            BOOST_TEST((help.find("ends, reduced units", end - 8) != std::string::npos) == reduced);
        }
}

BOOST_AUTO_TEST_CASE(bad_options_are_refused_in_one_line) {
    const std::vector<Words> bad{{"--nosuch", "1"},  {"--t-end", "-1"},
                                 {"--dt", "zero"},   {"--integrator", "euler"},
                                 {"--rtol", "1e-6"}, {"--transport", "fast"},
                                 {"--range", "0.5"}, {"--threads", "0"},
                                 {"--out", "file"},  {"word"}};
    std::size_t number = 0;
    for (const auto& name : problems)
        for (const auto& arguments : bad) BOOST_TEST_CONTEXT(name << " " << arguments.front()) {
                // Code that problems share: every third in each of them, all in long runs.
                if (++number % 3 != 0 && !long_runs()) continue;
                const Scratch folder;
                folder.write("file", "mine");
                Words all{"--smoke", "--no-plots"};
                all.insert(all.end(), arguments.begin(), arguments.end());
                const Outcome outcome = run_in(folder, name, all);
                BOOST_TEST(outcome.status == 2);
                BOOST_TEST(outcome.out == "");
                BOOST_TEST(outcome.err.starts_with(name + ": "));
                BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
                BOOST_TEST(folder.listing().size() == 1u);
            }
}

BOOST_AUTO_TEST_CASE(options_of_their_own_are_refused_where_they_make_no_sense) {
    const std::vector<RefusedCall> all{
        {"gas_cloud", {"--axes", "4,2"}, {"axes", "3 dimensions", "one for each"}},
        {"gas_cloud", {"--axes", "4,2,1,"}, {"axes", "''", "--axes 4,2,1"}},
        {"gas_cloud",
         {"--ranges", "ellipses", "--gradient-axes", "2"},
         {"gradient-axes", "too narrow", "give less"}},
        {"free_expansion",
         {"--front", "moving:", "--back", "mirror", "--dimension", "3"},
         {"front"}},
        {"parallel_efficiency", {"--sizes", "500,500"}, {"sizes", "500", "twice"}},
        {"gas_cloud", {"--axes", "1,2,x"}, {"axes", "'x'", "--axes 4,2,1"}},
        {"gas_cloud", {"--dimension", "2", "--axes", ",1"}, {"axes", "''", "--axes 2,1"}},
        {"stability", {"--lattice", "bcc"}, {"lattice", "--dimension 3"}},
        {"stability", {"--dimension", "3", "--cells", "8"}, {"cells", "--dimension 3"}},
        {"stability", {"--dimension", "3", "--range", "9"}, {"range", "9", "6 spacings"}},
        {"torsion", {"--columns", "2"}, {"columns", "2", "between 3"}},
        {"torsion", {"--transport", "plain"}, {"transport", "updated"}},
        {"torsion", {"--compare", "--columns", "5"}, {"columns", "--compare"}},
        {"rotating_body", {"--body", "pear"}, {"body", "pear", "cube"}},
        {"rotating_body", {"--compare"}, {"compare", "--body block"}},
        {"rotating_body", {"--speed", "0"}, {"speed", "0", "between"}},
        {"rotating_body",
         {"--formulation", "total_lagrangian", "--angular-momentum", "torque_pair"},
         {"angular-momentum", "updated"}},
        {"rotating_disk", {"--shape", "hexagon", "--radius", "7.5"}, {"radius", "7.5", "whole"}},
        {"rotating_disk", {"--radius", "2"}, {"radius", "2", "between 6 and"}},
        {"rotating_disk", {"--damping", "-1"}, {"damping", "-1"}},
        {"rotating_disk", {"--range", "13"}, {"range", "farther than h = 13 from the rim"}},
        {"rotating_disk", {"--model", "spam", "--range", "12.5"}, {"range", "nothing is inside"}},
        {"rotating_disk", {"--shape", "ring"}, {"shape", "ring", "disk"}},
        {"rotating_disk", {"--model", "md", "--transport", "plain"}, {"transport", "--model md"}},
        {"kernels", {"--family", "9"}, {"family", "9", "between 2 and 8"}},
        {"kernels", {"--largest-range", "1.2"}, {"largest-range", "1.2", "smallest-range"}},
        {"kernels", {"--t-end", "5"}, {"t-end", "integrates nothing"}},
        {"free_expansion", {"--cells", "6"}, {"cells", "range 6", "at least --cells 7"}},
        {"free_expansion", {"--range", "90"}, {"cells", "range 90", "at least --cells 91"}},
        {"free_expansion", {"--cells", "-3"}, {"cells", "-3", "between 2 and"}},
        {"free_expansion", {"--range", "-1"}, {"range", "-1", "above 0"}},
        {"free_expansion", {"--kernel", "gauss"}, {"kernel", "gauss", "lucy"}},
        {"free_expansion", {"--walls", "rigid"}, {"walls", "rigid", "periodic"}},
        {"free_expansion", {"--dimension", "4"}, {"dimension", "4", "between 1 and 3"}},
        {"free_expansion", {"--particles", "101"}, {"particles", "101", "100 and 121"}},
        {"free_expansion", {"--particles", "100", "--cells", "12"}, {"particles", "contradict"}},
        {"free_expansion", {"--compare", "--cells", "12"}, {"cells", "--compare"}},
        {"free_expansion", {"--cost", "--movie"}, {"movie", "--cost"}},
        {"free_expansion", {"--movie", "--no-plots"}, {"movie", "--no-plots"}},
        {"shock_tube", {"--toro", "6"}, {"toro", "6", "between 1 and 5"}},
        {"shock_tube", {"--compare", "--toro", "1"}, {"toro", "--compare"}},
        {"shock_tube", {"--compare", "--work", "own"}, {"work", "--compare"}},
        {"blast", {"--radius", "0.02", "--cells", "20"}, {"radius", "no particle", "--cells"}},
        {"blast", {"--ratio", "0.5"}, {"ratio", "between 1 and"}},
        {"blast", {"--work", "all"}, {"work", "all", "mean"}},
        {"lattice_stability", {"--cells", "7"}, {"cells", "7", "even"}},
        {"lattice_stability",
         {"--potential", "curvature", "--kernel", "lucy"},
         {"kernel", "curvature", "w4"}},
        {"lattice_stability", {"--potential", "density", "--strength", "1"}, {"strength"}},
        {"lattice_stability", {"--potential", "both", "--block", "14"}, {"block", "moves"}},
        {"lattice_stability", {"--potential", "both", "--range", "4.5"}, {"cells", "wide"}},
        {"lattice_stability", {"--potential", "both", "--t-end", "4"}, {"t-end", "integrates"}},
        {"relaxation", {"--outline", "nowhere.csv"}, {"outline", "nowhere.csv", "x,y"}},
        {"relaxation", {"--outline", "nowhere.csv", "--lobes", "4"}, {"lobes", "outline"}},
        {"relaxation", {"--outline", "."}, {"outline", "cannot be read"}},
        {"relaxation", {"--range", "0.9"}, {"range", "0.9"}},
        {"relaxation", {"--lobes", "4", "--depth", "0"}, {"lobes", "circle"}},
        {"relaxation", {"--outline", "/dev/zero"}, {"outline", "longer than 16 MiB"}},
        {"integrator_accuracy", {"--size", "9", "--problem", "wave"}, {"size", "--problem wave"}},
        {"invariant_drift", {"--periods", "9", "--problem", "md"}, {"periods", "--problem md"}},
        {"invariant_drift", {"--turns", "9", "--problem", "wave"}, {"turns", "--problem wave"}},
        {"rotating_hexagon",
         {"--model", "md", "--speed", "1000", "--t-end", "1e7"},
         {"which this case chooses"}},
        {"rotating_hexagon", {"--speed", "1", "--size="}, {"size", "--size= is missing"}},
        {"kernels", {"--rtol", "1e-8"}, {"rtol", "integrates nothing"}},
        {"kernels", {"--relaxation"}, {"relaxation", "integrates nothing"}},
        {"invariant_drift", {"--rtol", "1e-8"}, {"rtol", "many runs"}},
        {"stability", {"--viscosity", "1"}, {"stability: viscosity", "use 0"}},
        {"stability", {"--penalty", "1"}, {"penalty", "material_vectors"}},
        {"stability",
         {"--formulation", "material_vectors", "--penalty", "1", "--memoryless"},
         {"penalty", "memoryless"}},
        {"stability",
         {"--formulation", "material_vectors", "--stress", "-1"},
         {"stress", "bears no"}},
        {"material_vectors_study", {"--dt", "0.1"}, {"dt"}},
        {"thousand_turns", {"--turns", "1e12"}, {"steps"}},
        {"stability",
         {"--angular-momentum", "torque_pair"},
         {"stability: angular-momentum", "free"}},
        {"diffusion_waves",
         {"--wave", "thermal", "--density", "continuity"},
         {"density", "--wave thermal"}},
        {"plane_wave", {"--range", "1e308"}, {"range", "10000"}},
        {"tensile_instability", {"--range", "1e9"}, {"range"}},
        {"fragmenting_bar", {"--offset", "1e308"}, {"offset", "between"}},
        {"sheared_square", {"--cells", "2"}, {"cells", "2", "between 6 and 2000"}},
        {"sheared_square", {"--shear", "0.9"}, {"shear", "0.9", "0.5"}},
        {"sheared_square", {"--shear", "0"}, {"shear", "0"}},
    };
    check_refused(all);
}

BOOST_AUTO_TEST_CASE(help_and_the_list_of_problems_know_it) {
    for (const auto& name : problems) BOOST_TEST_CONTEXT(name) {
            const Scratch folder;
            const Outcome help = run_in(folder, name, {"--help"});
            BOOST_TEST(help.status == 0);
            BOOST_TEST(help.out.find("--smoke") != std::string::npos);
            for (std::size_t at = 0; (at = help.out.find("\n  --", at)) != std::string::npos;
                 ++at) {
                // Behind a long name the words begin on the next line.
                const auto end = help.out.find('\n', at + 1);
                std::string line = help.out.substr(at + 1, end - at);
                if (line.size() <= 31 && help.out.compare(end + 1, 20, std::string(20, ' ')) == 0)
                    line += help.out.substr(end + 1, help.out.find('\n', end + 1) - end);
                BOOST_TEST(line.find_first_not_of(" \n", 30) != std::string::npos,
                           line << " says nothing");
            }
            const std::string source =
                contents_of(std::string(SPAM_SOURCE) + "/problems/" + name + ".cpp");
            const auto at = source.find("// spam-list: ");
            BOOST_REQUIRE(at < 200u);
            const std::string line = source.substr(at, source.find('\n', at) - at);
            BOOST_TEST(line.find("; ") != std::string::npos, line << " names no run time");
        }
}

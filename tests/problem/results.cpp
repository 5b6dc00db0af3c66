// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a run: all there, right, and enough to run the same case again, bit for bit.
#include "problem/result_files.hpp"
#include <spam/core/threads.hpp>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <numbers>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

/// Runs in a folder of its own and must succeed; the results are in out/.
struct Run {
    Scratch folder;
    explicit Run(Words arguments) { again("out", std::move(arguments)); }
    void again(const std::string& out, Words arguments) {
        arguments.insert(arguments.end(), {"--out", out, "--no-plots"});
        const Outcome outcome = run(problem("rotating_hexagon", arguments), {folder.path()});
        BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
        BOOST_TEST(outcome.err == "");
    }
    std::filesystem::path operator/(const std::string& name) const { return folder / "out" / name; }
};

std::string header(const Csv& csv) {
    std::string line;
    for (const auto& name : csv.names) line.append(line.empty() ? "" : ",").append(name);
    return line;
}

/// What holds for every invariants.csv; returns the last time.
double check_invariants(const std::filesystem::path& file) {
    const Csv csv(file);
    BOOST_TEST(header(csv).starts_with(
        "t,dt,mass,momentum_x,momentum_y,angular_momentum,kinetic,internal,energy,"));
    const auto t = csv.column("t"), kinetic = csv.column("kinetic"),
               internal = csv.column("internal"), energy = csv.column("energy");
    BOOST_TEST(t.front() == 0.0);
    for (std::size_t k = 1; k < t.size(); ++k) BOOST_TEST(t[k] > t[k - 1]);
    for (std::size_t k = 0; k < t.size(); ++k)
        BOOST_TEST(energy[k] == kinetic[k] + internal[k], boost::test_tools::tolerance(1e-15));
    for (const auto& row : csv.cells)
        for (const auto& cell : row) {
            char exact[40];
            std::snprintf(exact, sizeof exact, "%.17g", Csv::number(cell));
            BOOST_TEST(cell == exact);
        }
    return t.back();
}

/// `of_one_run`: not the total of several, which have invariants of their own.
void check_statistics(const nlohmann::json& statistics, bool of_one_run = true) {
    Words keys;
    for (const auto& item : statistics.items()) keys.push_back(item.key());
    Words expected{"events",         "pair_interactions", "particles",   "problem",
                   "rejected_steps", "rhs_evaluations",   "steps",       "t_end",
                   "units",          "version",           "wall_seconds"};  // and no "stopped"
    if (of_one_run) expected.insert(expected.begin() + 1, "invariants");
    BOOST_TEST(keys == expected, boost::test_tools::per_element());
    BOOST_TEST(statistics["problem"] == "rotating_hexagon");
    BOOST_TEST(statistics["units"]["reduced"].get<std::string>().starts_with("1 is the mass"));
    BOOST_TEST(statistics["wall_seconds"].get<double>() > 0.0);
    BOOST_TEST(statistics["version"].get<std::string>() != "");
}

void check_results(const nlohmann::json& results) {
    BOOST_TEST(results.size() > 0u);
    for (const auto& item : results) {
        BOOST_TEST(item.size() == 6u);
        BOOST_TEST(item.at("name").get<std::string>() != "");
        BOOST_TEST(item.at("source").get<std::string>() != "");
        BOOST_TEST(item.at("value").is_number());
        BOOST_TEST(item.at("holds").get<bool>());
        if (item.at("expected").is_null()) continue;
        BOOST_TEST(std::abs(item["value"].get<double>() - item["expected"].get<double>()) <=
                   item.at("tolerance").get<double>());
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_single_run) {
    const Run run({"--smoke", "--transport", "monaghan"});
    const double t_end =
        0.1 * 2.0 * std::numbers::pi * 3 / 0.1;  // smoke: size 3, a tenth of a turn
    BOOST_TEST(check_invariants(run / "invariants.csv") == t_end,
               boost::test_tools::tolerance(1e-15));
    const auto statistics = json_of(run / "statistics.json");
    check_statistics(statistics);
    BOOST_TEST(statistics["particles"] == 37);
    BOOST_TEST(statistics["steps"] == 189);
    BOOST_TEST(statistics["rhs_evaluations"] == 4 * 189);
    BOOST_TEST(statistics["rejected_steps"] == 0);
    BOOST_TEST(statistics["events"] == 0);
    BOOST_TEST(statistics["t_end"].get<double>() == t_end, boost::test_tools::tolerance(1e-15));
    check_results(json_of(run / "result.json"));
    const std::string log = contents_of(run / "run.log");
    for (const char* words : {"--smoke --transport monaghan", "SUNDIALS", "machine", "100 %"})
        BOOST_TEST(log.find(words) != std::string::npos, "run.log has no '" << words << "'");
    BOOST_TEST(log.find('\x1b') == std::string::npos);
    for (const auto& [name, text] : run.folder.listing())
        BOOST_TEST(!name.ends_with(".tmp"), name << " is left over");
}

BOOST_AUTO_TEST_CASE(a_run_with_reflections_counts_them) {
    const Run run({"--smoke", "--closest-approach", "0.995"});
    const auto statistics = json_of(run / "statistics.json");
    check_statistics(statistics);
    BOOST_TEST(statistics["steps"] == 189);
    BOOST_TEST(statistics["events"] > 10);
    BOOST_TEST(statistics["rhs_evaluations"] > 4 * 189);
    check_results(json_of(run / "result.json"));
    BOOST_TEST(contents_of(run / "run.log").find("reflected at 0.995") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_total_lagrangian_run_and_its_case_read_back) {
    Run run({"--smoke", "--formulation", "total_lagrangian", "--penalty", "0.2"});
    check_invariants(run / "invariants.csv");
    check_statistics(json_of(run / "statistics.json"));
    const auto results = json_of(run / "result.json");
    check_results(results);
    const auto survived = std::find_if(results.begin(), results.end(), [](const auto& item) {
        return item["name"] == "turns_survived";
    });
    BOOST_TEST_REQUIRE((survived != results.end()));
    BOOST_TEST((*survived)["value"].get<double>() == 0.1, boost::test_tools::tolerance(1e-12));
    run.again("again", {"--config", "out/case.toml"});
    BOOST_TEST(
        (contents_of(run / "invariants.csv") == contents_of(run.folder / "again/invariants.csv")));
}

BOOST_AUTO_TEST_CASE(the_comparison) {
    const Run run({"--smoke"});
    const Words labels{"md", "plain", "monaghan", "monaghan_torque_pair"};
    std::size_t steps = 0;
    std::string columns = "t";
    for (const auto& label : labels) {
        const auto file = [&](const char* name) { return run / (label + "/" + name); };
        BOOST_TEST(check_invariants(file("invariants.csv")) > 18.0);
        const auto statistics = json_of(file("statistics.json"));
        check_statistics(statistics);
        steps += statistics["steps"].get<std::size_t>();
        BOOST_TEST(collection(file("snapshots.pvd")).size() >= 2u);
        for (const char* what : {"_angular_momentum_ratio", "_energy_drift", "_shape_error"})
            columns.append(",").append(label).append(what);
    }
    const auto total = json_of(run / "statistics.json");
    check_statistics(total, false);
    BOOST_TEST(total["steps"] == steps);
    check_results(json_of(run / "result.json"));
    const Csv comparison(run / "comparison.csv");
    BOOST_TEST(header(comparison) == columns);
    for (const auto& label : labels)
        BOOST_TEST(comparison.column(label + "_angular_momentum_ratio").front() == 1.0);
}

/// At this speed the kinetic energy is no number, whatever else is fine: nothing can be claimed.
BOOST_AUTO_TEST_CASE(an_energy_that_is_nan_does_not_pass) {
    const Scratch folder;
    const Outcome outcome = run(problem("rotating_hexagon", {"--smoke", "--transport", "plain",
                                                             "--speed", "1e300", "--no-plots"}),
                                {folder.path()});
    BOOST_TEST(outcome.status >= 1);
    BOOST_TEST(outcome.status <= 3);
    BOOST_TEST(outcome.out.find("ok    energy") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(one_row_for_every_output_time) {
    struct Expected {
        Words arguments;
        std::vector<double> t;
    };
    const std::string adaptive = "arkode:DORMAND_PRINCE_7_4_5";
    const std::vector<Expected> table{
        {{"--t-end", "1", "--output-every", "0.25"}, {0, 0.3, 0.5, 0.8, 1}},  // on the grid of dt
        {{"--t-end", "1", "--output-every", "0.1"}, {0, .1, .2, .3, .4, .5, .6, .7, .8, .9, 1}},
        {{"--t-end", "1", "--output-every", "0.4"}, {0, 0.4, 0.8, 1}},  // and one for the end
        {{"--t-end", "0.25", "--output-every", "100"}, {0, 0.25}},
        {{"--t-end", "0.05", "--output-every", "1e-9"}, {0, 0.05}},  // never twice the same state
        {{"--t-end", "1", "--output-every", "0.4", "--integrator", adaptive}, {0, 0.4, 0.8, 1}},
        {{"--t-end", "0.3", "--output-every", "0.1", "--integrator", adaptive}, {0, .1, .2, .3}},
    };
    for (const auto& expected : table) {
        Words arguments = expected.arguments;
        arguments.insert(arguments.end(), {"--smoke", "--transport", "plain"});
        const Run run(arguments);
        check_invariants(run / "invariants.csv");
        const auto t = Csv(run / "invariants.csv").column("t");
        BOOST_TEST(t == expected.t, boost::test_tools::tolerance(1e-14)
                                        << boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(case_toml_runs_the_same_case_again) {
    const std::vector<Words> cases{
        {"--size", "3", "--turns", "0.01", "--transport", "monaghan", "--angular-momentum",
         "torque_pair"},
        {"--size", "2", "--t-end", "3", "--density", "summed", "--range", "2.7", "--speed", "0.03"},
        {"--smoke", "--model", "md", "--dt", "0.07"},
        {"--size", "2", "--t-end", "3", "--transport", "average", "--integrator",
         "arkode:DORMAND_PRINCE_7_4_5"},
        {"--smoke", "--transport", "plain", "--integrator", "arkode:ZONNEVELD_5_3_4", "--dt",
         "0.3"},
        {"--smoke", "--threads", "2", "--mean-density", "geometric", "--density", "chain_rule",
         "--transport", "average", "--output-every", "0.7", "--snapshot-every", "3"},
        {"--smoke", "--t-end", "2", "--range", "2.9"},  // the comparison
    };
    for (const auto& arguments : cases) {
        Run run(arguments);
        std::filesystem::copy(run / "case.toml", run.folder / "case.toml");
        run.again("again", {"--config", "case.toml"});
        for (const char* name : {"invariants.csv", "md/invariants.csv", "plain/invariants.csv",
                                 "case.toml", "snapshots.pvd"}) {
            const auto first = run / name, second = run.folder / "again" / name;
            BOOST_TEST(std::filesystem::exists(first) == std::filesystem::exists(second));
            if (std::filesystem::exists(first))
                BOOST_TEST((contents_of(first) == contents_of(second)),
                           arguments[0] << " " << arguments[1] << ": another " << name);
        }
    }
}

/// Bodies are of solids: what random places happen to connect is none.
BOOST_AUTO_TEST_CASE(random_starts_have_no_columns_of_bodies) {
    const Scratch folder;
    for (const auto& [name, more] :
         {std::pair{std::string("relaxation"), Words{"--particles", "300", "--t-end", "1"}},
          {"string_phase", {"--core", "0", "--t-end", "1"}},
          {"drop", {"--surface-tension", "0", "--disorder", "0.5", "--t-end", "1"}}}) {
        Words words{"--smoke", "--no-plots", "--out", name};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(problem(name, words), {folder.path()});
        BOOST_TEST(outcome.status == 0, outcome.out << outcome.err);
        BOOST_TEST(header(Csv(folder / (name + "/invariants.csv"))).find("_body_") ==
                   std::string::npos);
    }
}

/// Turns of more digits than six are asked for and survived; what L may drift grows with the turns.
BOOST_AUTO_TEST_CASE(any_number_of_turns_is_survived) {
    const Scratch folder;
    for (const std::string turns : {"0.20000001", "3"}) {
        const Outcome outcome = run(
            problem("turns_survived", {"--smoke", "--no-plots", "--turns", turns, "--out", turns}),
            {folder.path()});
        BOOST_TEST(outcome.status == 0, outcome.out << outcome.err);
        for (const auto& check : json_of(folder / (turns + "/result.json")))
            if (check["name"] == "molecular_dynamics_survives")
                BOOST_TEST(check["value"].get<double>() == std::stod(turns));
    }
}

/// At this speed molecular dynamics loses the shape in the last row of all, at the end of the turns asked for.
BOOST_AUTO_TEST_CASE(a_shape_lost_in_the_last_row_has_not_survived) {
    const Scratch folder;
    const Outcome outcome = run(problem("turns_survived", {"--smoke", "--no-plots", "--speed", "1",
                                                           "--turns", "0.166", "--out", "o"}),
                                {folder.path()});
    BOOST_TEST(outcome.status == 0,
               outcome.out << outcome.err);  // nothing is claimed near the speed of sound
    int found = 0;
    for (const auto& check : json_of(folder / "o/result.json")) {
        if (check["name"] == "molecular_dynamics_turns") BOOST_TEST(check["source"] == "deformed");
        const bool molecules = check["name"] == "molecular_dynamics_survives";
        if (!molecules && check["name"] != "total_lagrangian_survives") continue;
        BOOST_TEST((check["value"].get<double>() < 0.166) == molecules);
        ++found;
    }
    BOOST_TEST(found == 2);
}

/// Steps so long that RK4 may lose nearly everything: no limit is better than one that cannot fail.
BOOST_AUTO_TEST_CASE(a_drift_is_judged_only_where_it_can_be_too_large) {
    const Scratch folder;
    const Outcome outcome =
        run(problem("turns_survived", {"--smoke", "--no-plots", "--speed", "1", "--dt", "0.9",
                                       "--turns", "1", "--out", "o"}),
            {folder.path()});
    std::size_t drifts = 0;
    for (const auto& check : json_of(folder / "o/result.json")) {
        if (!check["name"].get<std::string>().ends_with("_L_drift")) continue;
        ++drifts;
        BOOST_TEST(check["expected"].is_null(), check.dump() << outcome.out << outcome.err);
    }
    BOOST_TEST(drifts == 3u);  // molecules, total Lagrangian, material vectors
}

BOOST_AUTO_TEST_CASE(threads_are_chosen_by_size_and_change_no_bit) {
    const Scratch folder;
    const int chosen = spam::worthwhile_threads(4096, spam::usable_cores());
    for (const std::string threads : {"auto", "1", "2"})
        BOOST_TEST(run(problem("free_expansion",
                               {"--cells", "64", "--t-end", "0.5", "--no-plots", "--quiet",
                                "--threads", threads, "--out", (folder / threads).string()}))
                       .status == 0);
    const std::string rows = contents_of(folder / "auto/invariants.csv");
    BOOST_TEST(rows == contents_of(folder / "1/invariants.csv"));
    BOOST_TEST(rows == contents_of(folder / "2/invariants.csv"));
    const std::string log = contents_of(folder / "auto/run.log");
    const std::string said =
        ", " + std::to_string(chosen) + (chosen == 1 ? " thread," : " threads,");
    BOOST_TEST(log.find(said) != std::string::npos, log);
}

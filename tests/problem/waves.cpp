// SPDX-License-Identifier: GPL-3.0-or-later
// The problems of lattice waves as a user runs them: what they measure, and that the one which
// integrates nothing keeps to the contract of all.
#include "problem/refused.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

Outcome run_in(const Scratch& folder, const std::string& name, Words arguments) {
    arguments.insert(arguments.end(), {"--out", "out", "--no-plots"});
    return run(problem(name, arguments), {folder.path()});
}

/// Results by name of a call that must succeed.
std::map<std::string, double> results_of(const std::string& name, const Words& arguments) {
    const Scratch folder;
    const Outcome outcome = run_in(folder, name, arguments);
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    std::map<std::string, double> values;
    for (const auto& item : json_of(folder / "out/result.json")) {
        BOOST_TEST(item["holds"] == true, item.dump());
        if (item["value"].is_number()) values[item["name"]] = item["value"];
    }
    return values;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_analysis_leaves_what_a_run_leaves) {
    const Scratch folder;
    const Words arguments{"--smoke", "--stress", "0.01"};
    BOOST_TEST(run_in(folder, "stability", arguments).status == 0);
    for (const char* name : {"case.toml", "run.log", "result.json", "statistics.json"})
        BOOST_TEST(std::filesystem::exists(folder / ("out/" + std::string(name))), name);
    const auto statistics = json_of(folder / "out/statistics.json");
    BOOST_TEST(statistics["problem"] == "stability");
    BOOST_TEST(statistics["steps"] == 0);
    BOOST_TEST(statistics["rhs_evaluations"] > 90);
    BOOST_TEST(statistics["wall_seconds"] > 0.0);
    const Csv path(folder / "out/dispersion_monaghan.csv");
    BOOST_TEST(path.column("distance").front() == 0.0);
    BOOST_TEST(path.column("growth_rate").size() > 50U);
    BOOST_TEST(Csv(folder / "out/sample_plain.csv").cells.size() == 64U);

    const auto first = folder.listing();
    BOOST_TEST(run_in(folder, "stability", arguments).status == 2);  // never overwrites
    BOOST_TEST((folder.listing() == first));
    // The case as written back, again.
    const Outcome again = run(
        problem("stability", {"--config", "out/case.toml", "--smoke", "--no-plots", "--out", "b"}),
        {folder.path()});
    BOOST_TEST(again.status == 0, again.err);
    BOOST_TEST(contents_of(folder / "b/result.json") == contents_of(folder / "out/result.json"));
    BOOST_TEST(run_in(folder, "stability", {"--smoke", "--force"}).status == 0);
    BOOST_TEST(std::filesystem::exists(folder / "out.old-1/result.json"));
}

BOOST_AUTO_TEST_CASE(a_dry_analysis_writes_nothing) {
    const Scratch folder;
    const Outcome outcome = run_in(folder, "stability", {"--dry-run"});
    BOOST_TEST(outcome.status == 0);
    BOOST_TEST(contains(outcome.out, "nothing computed"));
    BOOST_TEST(folder.listing().empty());
}

BOOST_AUTO_TEST_CASE(what_an_analysis_cannot_use_is_refused) {
    check_refused(std::vector<RefusedCall>{
        {"stability", {"--dt", "0.1"}, {"integrates nothing"}},
        {"stability", {"--t-end", "5"}, {"t-end"}},
        {"stability", {"--angular-momentum", "torque_pair"}, {"no derivative"}},
        {"stability", {"--cells", "7"}, {"even number"}},
        {"plane_wave", {"--cells", "6"}, {"cells"}},
        {"tensile_instability", {"--cells", "9"}, {"even number"}},
    });
}

BOOST_AUTO_TEST_CASE(tension_grows_and_averages_slow_it) {
    const auto values = results_of("stability", {"--cells", "12"});
    BOOST_TEST(values.at("plain_growth_rate") > 5.0 * values.at("monaghan_growth_rate"));
    BOOST_TEST(values.at("monaghan_growth_rate") > 1e-3);  // slower, not gone
    BOOST_TEST(
        results_of("stability", {"--cells", "12", "--stress", "0"}).at("plain_growth_rate") == 0.0);
}

BOOST_AUTO_TEST_CASE(the_growth_of_the_figure) {
    for (const char* stress : {"0.01", "0.02"}) {
        const auto values = results_of("tensile_instability",
                                       {"--stress", stress, "--cells", "12", "--t-end", "450"});
        const double predicted = values.at("kinetic_growth_rate_predicted");
        BOOST_TEST(values.at("kinetic_growth_rate") == predicted,
                   boost::test_tools::tolerance(0.03));
        BOOST_TEST(values.at("kinetic_growth_rate") == values.at("kinetic_growth_rate_all_modes"),
                   boost::test_tools::tolerance(2e-3));
    }
    const auto averaged = results_of(
        "tensile_instability",
        {"--stress", "0.02", "--transport", "average", "--cells", "12", "--t-end", "400"});
    BOOST_TEST(averaged.at("largest_kinetic_ratio") < 100.0);
    BOOST_TEST(!averaged.contains("kinetic_growth_rate"));
}

BOOST_AUTO_TEST_CASE(small_waves_keep_the_period_of_the_lattice) {
    for (const char* polarization : {"transverse", "longitudinal"}) {
        const auto values =
            results_of("plane_wave", {"--polarization", polarization, "--amplitude", "0.01"});
        BOOST_TEST(values.at("period") == values.at("period_lattice"),
                   boost::test_tools::tolerance(1e-4));
        BOOST_TEST(values.at("period") > 1.03 * values.at("period_continuum"));
    }
}

// The distance is in proportion to the perturbation; where matter is under tension it grows, with averages it does not.
BOOST_AUTO_TEST_CASE(a_perturbed_wave_stays_near_the_other_one) {
    const Words small{"--cells", "16", "--t-end", "60"};
    const auto found = [&](const Words& more) {
        Words all = small;
        all.insert(all.end(), more.begin(), more.end());
        return results_of("plane_wave", all);
    };
    const auto a = found({"--perturb", "1e-6"}), b = found({"--perturb", "1e-4"});
    const auto averaged = found({"--perturb", "1e-6", "--transport", "monaghan"});
    for (const std::string name : {"transverse", "longitudinal"}) {
        const std::string distance = name + "_perturbed_largest_distance";
        BOOST_TEST(a.at(distance) == b.at(distance), boost::test_tools::tolerance(5e-3));
        BOOST_TEST(a.at(distance) > 0.7);
        BOOST_TEST(averaged.at(distance) < 1.0);
        // The waves themselves are those without the option.
        BOOST_TEST(a.at(name == "transverse" ? "period" : "longitudinal_period") ==
                   b.at(name == "transverse" ? "period" : "longitudinal_period"));
    }
    BOOST_TEST(a.at("longitudinal_perturbed_largest_distance") >
               2.0 * a.at("transverse_perturbed_largest_distance"));
    // By itself it ends earlier, at 3 of its own periods: nothing that was measured for the longer run is claimed.
    const auto alone =
        results_of("plane_wave", {"--perturb", "1e-6", "--polarization", "longitudinal"});
    BOOST_TEST(alone.at("perturbed_largest_distance") > 1.0);
}

BOOST_AUTO_TEST_CASE(defaults_and_smoke) {
    for (const char* name : {"stability", "tensile_instability", "plane_wave"})
        results_of(name, {"--smoke"});
}

BOOST_AUTO_TEST_CASE(balanced_torques_promise_no_angular_momentum_in_a_periodic_box) {
    const auto values = results_of(
        "plane_wave", {"--smoke", "--transport", "monaghan", "--angular-momentum", "torque_pair"});
    BOOST_TEST(!values.contains("angular_momentum_drift"));
    BOOST_TEST(values.contains("energy_drift"));
}

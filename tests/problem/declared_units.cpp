// SPDX-License-Identifier: GPL-3.0-or-later
// Units as a user sees them, ends that follow what they depend on, and the picture of what is watched.
#include "problem/refused.hpp"
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

/// A smoke run in a folder of its own, which must succeed.
struct Run {
    Scratch folder;
    std::string said;
    Run(const std::string& name, const Words& more) {
        Words words{"--smoke", "--out", "out"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(problem(name, words), {folder.path()});
        BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
        said = outcome.out;
    }
    std::filesystem::path operator/(const std::string& name) const { return folder / "out" / name; }
};

/// Where a run would end by itself.
double end_of(const std::string& name, Words words) {
    words.emplace_back("--dry-run");
    const Outcome outcome = run(problem(name, words));
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    const std::size_t at = outcome.out.find(", to t = ");
    BOOST_REQUIRE(at != std::string::npos);
    return std::stod(outcome.out.substr(at + 9));
}

/// The curves of a picture by frame and name ("momentum less impulse: y"): the numbers that gnuplot is given.
std::map<std::string, std::vector<double>> curves_of(const std::filesystem::path& file) {
    std::map<std::string, std::vector<double>> all;
    std::vector<double>* now = nullptr;
    for (const std::string& line : split(contents_of(file), '\n')) {
        if (line.starts_with("# ")) now = &all[line.substr(2)];
        const std::size_t blank = line.find(' ');
        if (line.starts_with('#') || blank == std::string::npos || now == nullptr) continue;
        const double value = std::strtod(line.c_str() + blank, nullptr);
        if (std::isfinite(value)) now->push_back(value);
    }
    return all;
}

double largest(const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_in_mm_and_microseconds_says_so) {
    const Run bar("taylor_bar", {"--t-end", "0.5 µs", "--yield-stress", "0.4 GPa"});
    BOOST_TEST(bar.said.find("units       mm, g, µs; stress TPa, speed mm/µs\n") !=
               std::string::npos);
    const auto units = json_of(bar / "statistics.json")["units"];
    BOOST_TEST(units["time"] == "µs");
    BOOST_TEST(units["stress"] == "TPa");
    BOOST_TEST(units["momentum"] == "g mm/µs");
    const std::string file = contents_of(bar / "case.toml");
    for (const char* line : {"t-end = 0.5  # µs\n", "yield-stress = 0.4  # GPa\n",
                             "speed = 227  # m/s\n", "radius = 3.2  # mm\n"})
        BOOST_TEST(file.find(line) != std::string::npos, line << " is not in " << file);
    const Vtp snapshot(bar / "snapshot_0000.vtp");
    BOOST_TEST(snapshot.units.at("Points") == "mm");
    BOOST_TEST(snapshot.units.at("velocity") == "mm/µs");
    BOOST_TEST(snapshot.units.at("density") == "g/mm³");
    BOOST_TEST(snapshot.units.count("id") == 0u);
    BOOST_TEST(snapshot.about.at("units") == "mm, g, µs; stress TPa, speed mm/µs");
    const std::string picture = contents_of(bar / "plots/invariants.gp");
    BOOST_TEST(picture.find("\"t, µs\"") != std::string::npos);
    BOOST_TEST(picture.find("\"energy, kJ\"") != std::string::npos);

    const Run again("taylor_bar", {"--config", (bar / "case.toml").string(), "--no-plots"});
    BOOST_TEST(contents_of(bar / "invariants.csv") == contents_of(again / "invariants.csv"));
}

/// A thousand times as large is a thousand times as slow.
BOOST_AUTO_TEST_CASE(ends_follow_sizes_and_speeds) {
    const Words coarse{"--particles-per-radius", "3"};
    BOOST_TEST(end_of("taylor_bar", coarse) == 80.0);
    for (const auto& [radius, end] : {std::pair{"3200", 8e4}, {"3.2e-3", 8e-2}})
        BOOST_TEST(end_of("taylor_bar", {"--particles-per-radius", "3", "--radius", radius}) == end,
                   boost::test_tools::tolerance(1e-5));
    const double fast = end_of("taylor_bar", {"--particles-per-radius", "3", "--speed", "400"});
    BOOST_TEST(fast > 60.0);
    BOOST_TEST(fast < 110.0);
    BOOST_TEST(end_of("taylor_bar", {"--particles-per-radius", "3", "--speed", "1"}) > 1.0);

    BOOST_TEST(end_of("colliding_rings", {}) == 640.0);
    BOOST_TEST(end_of("colliding_rings", {"--smoke"}) == 40.0);
    BOOST_TEST(end_of("colliding_rings", {"--radius", "32", "--inner-radius", "24"}) == 1280.0);
    BOOST_TEST(end_of("colliding_rings", {"--speed", "0.005"}) > 3000.0);
    for (const std::string name : {"fragmenting_bar", "pierced_bar"}) {
        BOOST_TEST(end_of(name, {}) == 200.0);
        BOOST_TEST(end_of(name, {"--speed", "0.5"}) == 400.0);
    }
}

/// In the field of gravity, between walls, momentum and energy change: the picture shows what does not.
BOOST_AUTO_TEST_CASE(pictures_show_what_must_stay_constant) {
    const Run water("water_column", {});
    for (const std::string label : {"relaxation/", "collapse/"}) {
        const auto curves = curves_of(water / (label + "plots/invariants.dat"));
        double given = 0.0;
        for (const double p : Csv(water / (label + "invariants.csv")).column("impulse_y"))
            given = std::max(given, std::abs(p));
        BOOST_TEST(given > 0.1);
        BOOST_REQUIRE(curves.count("momentum less impulse: y") == 1u);
        BOOST_TEST(largest(curves.at("momentum less impulse: y")) < 1e-9 * given);
        for (const char* also : {"momentum less impulse: x", "energy less work and heat: ",
                                 "angular momentum less angular impulse: "})
            BOOST_TEST(curves.count(also) == 1u, also);
    }
    const Run bar("taylor_bar", {"--t-end", "0.5"});  // in space, at a wall
    const auto curves = curves_of(bar / "plots/invariants.dat");
    for (const char* axis : {"x", "y", "z"})
        for (const std::string watched :
             {"momentum less impulse: ", "angular momentum less angular impulse: "})
            BOOST_TEST(curves.count(watched + axis) == 1u, watched << axis);
    const Run plain("rotating_hexagon", {"--transport", "plain", "--t-end", "1"});
    BOOST_TEST(contents_of(plain / "plots/invariants.gp").find("\"t, reduced units\"") !=
               std::string::npos);
    for (const char* name : {"momentum: x", "momentum: y", "angular momentum: ", "energy: "})
        BOOST_TEST(curves_of(plain / "plots/invariants.dat").count(name) == 1u, name);
}

BOOST_AUTO_TEST_CASE(a_run_without_end_names_the_end) {
    check_refused({{"taylor_bar", {"--t-end", "1e12"}, {"dt: ", "give an earlier end"}}});
}

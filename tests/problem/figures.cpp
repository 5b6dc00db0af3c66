// SPDX-License-Identifier: GPL-3.0-or-later
// rotating_hexagon --figure 4, 5, 6, 7: each is drawn by one command, and what it settles cannot be
// asked for otherwise.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

Outcome hexagon(const Scratch& folder, Words arguments) {
    arguments.insert(arguments.end(), {"--smoke", "--size", "2", "--out", "out"});
    return Child(problem("rotating_hexagon", arguments), {folder.path()})
        .finish(Child::Seconds(240));
}

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_figure_has_the_panels_of_the_paper) {
    const std::map<std::string, std::pair<std::size_t, Words>> figures{
        {"4", {3, {"md", "summed", "continuity"}}},
        {"5", {8, {"average", "monaghan", "average_chain_rule", "monaghan_chain_rule"}}},
        {"6", {1, {"average", "monaghan"}}},
        {"7",
         {4,
          {"average_torque_pair", "monaghan_torque_pair", "average_torque_particle",
           "monaghan_torque_particle"}}}};
    for (const auto& [figure, expected] : figures) BOOST_TEST_CONTEXT("figure " << figure) {
            const Scratch folder;
            const Outcome outcome = hexagon(folder, {"--figure", figure});
            // Whether the claims hold for so few particles is not asked here.
            BOOST_TEST(outcome.status <= 1, outcome.out << outcome.err);
            for (const auto& label : expected.second)
                BOOST_TEST(std::filesystem::exists(folder / ("out/" + label + "/invariants.csv")));
            const std::string script = contents_of(folder / ("out/plots/figure_" + figure + ".gp"));
            BOOST_TEST(count(script, "\nplot ") == expected.first);
            if (figure != "6")
                for (std::size_t k = 0; k < expected.first; ++k) {
                    const std::string letter{'(', static_cast<char>('a' + k), ')'};
                    BOOST_TEST(count(script, letter) == 1u, letter);
                }
        }
}

BOOST_AUTO_TEST_CASE(a_figure_settles_the_scheme_and_the_end) {
    const std::vector<Words> settled{
        {"density", "summed"}, {"transport", "plain"},       {"mean-density", "geometric"},
        {"model", "md"},       {"angular-momentum", "free"}, {"turns", "2"},
        {"t-end", "5"}};
    for (const auto& option : settled) BOOST_TEST_CONTEXT(option[0]) {
            const Scratch folder;
            const Outcome outcome = hexagon(folder, {"--figure", "5", "--" + option[0], option[1]});
            BOOST_TEST(outcome.status == 2);
            BOOST_TEST(outcome.err.starts_with("rotating_hexagon: " + option[0] + ": --figure 5"));
            BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
            BOOST_TEST(folder.listing().empty());
        }
    for (const std::string figure : {"3", "8", "4.5", "all"}) {
        const Scratch folder;
        const Outcome outcome = hexagon(folder, {"--figure", figure});
        BOOST_TEST(outcome.status == 2);
        BOOST_TEST(outcome.err.find("4, 5, 6 or 7") != std::string::npos, outcome.err);
    }
}

/// What the paper says of the standard case stands beside what the scheme promises.
BOOST_AUTO_TEST_CASE(checks_have_names_of_their_own) {
    for (const Words& words :
         {Words{"--figure", "6"}, Words{"--formulation", "total_lagrangian"}}) {
        const Scratch folder;
        Words arguments{"--no-plots", "--out", "out"};
        arguments.insert(arguments.end(), words.begin(), words.end());
        BOOST_TEST(run(problem("rotating_hexagon", arguments), {folder.path()}).status == 0);
        std::map<std::string, int> times;
        for (const auto& item : json_of(folder / "out/result.json")) ++times[item.at("name")];
        for (const auto& [name, n] : times)
            BOOST_TEST(n == 1, name << " is there " << n << " times");
        const bool figure = words.front() == "--figure";
        BOOST_TEST(times.count(figure ? "average_energy_change_final" : "energy_change_largest") ==
                   1U);
        BOOST_TEST(times.count(figure ? "average_energy_drift" : "energy_drift") == 1U);
    }
}

BOOST_AUTO_TEST_CASE(other_options_still_work) {
    const Scratch folder;
    const Words arguments{"--figure", "4", "--speed", "0.2", "--dt", "0.2", "--no-plots"};
    BOOST_TEST(hexagon(folder, arguments).status <= 1);
    const std::string settled = contents_of(folder / "out/case.toml");
    for (const char* line : {"figure = 4", "speed = 0.2", "dt = 0.2", "size = 2"})
        BOOST_TEST(settled.find(line) != std::string::npos, settled);
    BOOST_TEST(settled.find("density") == std::string::npos);
}

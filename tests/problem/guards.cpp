// SPDX-License-Identifier: GPL-3.0-or-later
// What a run does when an invariant leaves its limit, and what every problem says of itself.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

/// Springs whose energy classical Runge-Kutta keeps to a millionth at this step.
Outcome springs(const Scratch& folder, const Words& more) {
    Words words{"--model", "md",   "--size", "3",          "--t-end", "19", "--output-every",
                "1",       "--dt", "0.5",    "--no-plots", "--out",   "out"};
    words.insert(words.end(), more.begin(), more.end());
    return run(problem("rotating_hexagon", words), {folder.path()});
}

std::size_t times(const std::string& word, const std::string& text) {
    std::size_t count = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_warning_comes_once) {
    const Scratch folder;
    const Outcome outcome = springs(folder, {"--limit-energy", "1e-9"});
    BOOST_TEST(times("warning", outcome.out) == 1u);
    BOOST_TEST(outcome.out.find("energy changed by") != std::string::npos, outcome.out);
    BOOST_TEST(outcome.out.find("more than the limit 1e-09") != std::string::npos);
    BOOST_TEST(times("warning", contents_of(folder / "out/run.log")) == 1u);
    BOOST_TEST(times("energy beyond its limit", contents_of(folder / "out/events.csv")) == 1u);
    BOOST_TEST(Csv(folder / "out/invariants.csv").column("t").back() == 19.0);
}

BOOST_AUTO_TEST_CASE(a_stop_leaves_complete_results) {
    const Scratch folder;
    const Outcome outcome = springs(folder, {"--limit-energy", "1e-9", "--guard", "stop"});
    BOOST_TEST(outcome.status == 3);
    BOOST_TEST(times("\n", outcome.err) == 1u);
    BOOST_TEST(outcome.err.find("stopped: energy changed by") != std::string::npos, outcome.err);
    const Csv rows(folder / "out/invariants.csv");
    BOOST_TEST(rows.column("t").back() == 1.0);
    const auto energy = rows.column("energy");
    BOOST_TEST(std::abs(energy.back() - energy.front()) > 1e-9 * energy.front());
    const auto statistics = json_of(folder / "out/statistics.json");
    BOOST_TEST(statistics.at("stopped").get<std::string>().find("energy changed by") == 0u);
    BOOST_TEST(json_of(folder / "out/result.json").is_array());
    BOOST_TEST(contents_of(folder / "out/snapshots.pvd").find("</VTKFile>") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(nothing_is_said_within_the_limits) {
    for (const Words& quiet : {Words{"--limit-energy", "1e-3"}, Words{"--guard", "off"},
                               Words{"--limit-energy", "1e-3", "--guard", "stop"}}) {
        const Scratch folder;
        const Outcome outcome = springs(folder, quiet);
        BOOST_TEST(outcome.status != 3);
        BOOST_TEST(times("warning", outcome.out) == 0u, outcome.out);
        BOOST_TEST(!std::filesystem::exists(folder / "out/events.csv"));
    }
}

/// An invariant that the scheme does not keep is watched where a limit is given.
BOOST_AUTO_TEST_CASE(what_is_not_promised_needs_a_limit) {
    const Words plain{"--size",     "3",     "--transport", "monaghan", "--t-end", "19",
                      "--no-plots", "--out", "out",         "--guard",  "stop"};
    const Scratch one, other;
    BOOST_TEST(run(problem("rotating_hexagon", plain), {one.path()}).status == 0);
    Words limited = plain;
    limited.insert(limited.end(), {"--limit-angular-momentum", "1e-6"});
    const Outcome outcome = run(problem("rotating_hexagon", limited), {other.path()});
    BOOST_TEST(outcome.status == 3);
    BOOST_TEST(outcome.err.find("angular momentum changed by") != std::string::npos, outcome.err);
}

BOOST_AUTO_TEST_CASE(an_interval_longer_than_the_run_is_remarked_on) {
    const Scratch folder;
    const Outcome outcome = springs(folder, {"--snapshot-every", "20", "--dry-run"});
    BOOST_TEST(outcome.status == 0);
    BOOST_TEST(outcome.out.find("--snapshot-every 20 is longer than the run") != std::string::npos,
               outcome.out);
    BOOST_TEST(times("longer than the run", outcome.out) == 1u);
}

BOOST_AUTO_TEST_CASE(every_problem_says_its_version) {
    for (const auto& name : split(SPAM_PROBLEM_NAMES, ',')) {
        const Scratch folder;
        const Outcome outcome = run(problem(name, {"--version"}), {folder.path()});
        BOOST_TEST(outcome.status == 0);
        BOOST_TEST(outcome.out.starts_with(name + ": spam "), outcome.out);
        BOOST_TEST(outcome.out.find(", SUNDIALS ") != std::string::npos);
        BOOST_TEST(times("\n", outcome.out) == 1u);
        BOOST_TEST(folder.listing().empty());
    }
}

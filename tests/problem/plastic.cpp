// SPDX-License-Identifier: GPL-3.0-or-later
// Solids that yield as a user runs them: the errors of three ways to yield, a bar of Taylor's, and input that
// makes no sense.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

using namespace spam::test;

namespace {

nlohmann::json results_of(const std::string& name, const Words& arguments) {
    const Scratch folder;
    const Outcome outcome = run_in(folder, name, arguments);
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    return json_of(folder / "out/result.json");
}

}  // namespace

/// The errors are claims of the problem itself.
BOOST_AUTO_TEST_CASE(three_ways_to_yield_have_the_errors_that_are_known) {
    if (SPAM_SANITIZED) {
        results_of("plastic_block", {"--compare", "--smoke"});
        return;
    }
    std::size_t claims = 0;
    for (const auto& item : results_of("plastic_block", {"--compare"}))
        if (!item.at("expected").is_null()) ++claims;
    BOOST_TEST(claims >= 24U);
}

/// What an adaptive run's tolerance does not control is said before it begins.
BOOST_AUTO_TEST_CASE(adaptive_runs_say_what_their_tolerance_does_not_control) {
    const Words adaptive{"--integrator", "arkode:DORMAND_PRINCE_7_4_5", "--dry-run"};
    const Scratch folder;
    const auto said = [&](const std::string& yield) {
        Words words = adaptive;
        words.insert(words.end(), {"--yield", yield});
        return run_in(folder, "plastic_block", words).out.find("tolerances do not control") !=
               std::string::npos;
    };
    BOOST_TEST(said("return"));
    BOOST_TEST(!said("smooth"));
}

BOOST_AUTO_TEST_CASE(every_form_runs) {
    for (const char* formulation : {"updated", "total_lagrangian"})
        for (const char* yield : {"return", "after", "smooth"})
            results_of("plastic_block", {"--formulation", formulation, "--yield", yield, "--smoke",
                                         "--dt", "0.0625"});
}

BOOST_AUTO_TEST_CASE(a_coarse_bar_keeps_a_foot) {
    const std::string end = effort<std::string>("24", "4");
    for (const auto& item :
         results_of("taylor_bar", {"--particles-per-radius", "3", "--t-end", end})) {
        if (item["name"] == "foot" && !SPAM_SANITIZED) BOOST_TEST(item["value"] > 5.0);
        if (item["name"] == "energy_change") BOOST_TEST(item["value"] < 1e-3);
    }
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense_is_refused) {
    const std::vector<RefusedCall> all{
        {"plastic_block", {"--yield-stress", "-1"}, {"yield-stress: '-1'"}},
        {"plastic_block", {"--hardening", "-1"}, {"hardening: '-1'"}},
        {"plastic_block",
         {"--yield-width", "0.2"},
         {"yield-width: has a meaning for --yield smooth"}},
        {"plastic_block", {"--yield", "smooth", "--yield-width", "2"}, {"yield-width: '2'"}},
        {"plastic_block", {"--penalty", "0.2"}, {"penalty: has a meaning"}},
        {"plastic_block", {"--integrator", "cvode:adams"}, {"a material that yields"}},
        {"plastic_block",
         {"--compare", "--yield", "after"},
         {"yield: has no effect with --compare"}},
        {"plastic_block", {"--compare", "--dt", "0.1"}, {"dt"}},
        {"taylor_bar", {"--poisson", "0.5"}, {"poisson: '0.5'"}},
        {"taylor_bar", {"--compare", "--particles-per-radius", "3"}, {"--compare"}},
        {"taylor_bar", {"--particles-per-radius", "1"}, {"particles-per-radius: '1'"}},
    };
    check_refused(all);
}

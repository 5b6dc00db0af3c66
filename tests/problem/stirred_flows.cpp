// SPDX-License-Identifier: GPL-3.0-or-later
// Flows that stir their particles as a user runs them: vortices that decay, a cavity with a moving lid.
#include "problem/found.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(vortices_decay_as_they_should_where_particles_are_shifted) {
    const Results found("taylor_green", {}, "shifting_velocity_error");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(std::abs(found.value.at("shifting_decay_rate") / 0.789568 - 1.0) < 0.02);
    BOOST_TEST(found.value.at("shifting_velocity_error_half") < 0.03);
    // What the comparison is for.
    BOOST_TEST(found.value.at("plain_velocity_error_half") > 0.3);
    BOOST_TEST(found.value.at("plain_decay_rate") > 1.5);
}

BOOST_AUTO_TEST_CASE(disorder_at_the_start_does_no_harm) {
    if (!long_runs()) return;  // the same law once more
    const Results found("taylor_green", {"--disorder", "0.2", "--t-end", "125"},
                        "shifting_velocity_error");
    BOOST_TEST(found.claims == 0U);
    BOOST_TEST(found.value.at("shifting_velocity_error") < 0.03);
}

// Both columns exist, and what they say at the start is exact but for the lattice.
BOOST_AUTO_TEST_CASE(errors_begin_at_zero) {
    const Scratch folder;
    const Outcome outcome = run_in(folder, "taylor_green", {"--transport", "plain", "--smoke"});
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
    const Csv rows(folder / "out/invariants.csv");
    BOOST_TEST(rows.column("velocity_error").front() < 1e-12);
    BOOST_TEST(std::abs(rows.column("decay").front() - 1.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_cavity_has_ghias_profile) {
    const Results found("cavity", long_runs() ? Words{} : Words{"--cells", "20"}, "u_at_0.5000");
    BOOST_TEST(found.claims == (long_runs() ? 1U : 0U));
    BOOST_TEST(found.value.at("off_ghia") < 0.02);
    BOOST_TEST(found.value.at("stirred") > 0.06);
}

BOOST_AUTO_TEST_CASE(another_reynolds_number_is_compared_with_nothing) {
    const Results found("cavity", {"--smoke", "--reynolds", "50"}, "stirred");
    BOOST_TEST(found.value.count("off_ghia") == 0U);
    BOOST_TEST(found.value.count("u_at_0.5000") == 0U);
}

BOOST_AUTO_TEST_CASE(a_strength_without_shifting_is_refused) {
    const Scratch folder;
    const Outcome outcome =
        run_in(folder, "taylor_green", {"--transport", "plain", "--shifting", "0.5"});
    BOOST_TEST(outcome.status == 2);
    BOOST_TEST(
        outcome.err.find("shifting: has no meaning with --transport plain") != std::string::npos,
        outcome.err);
}

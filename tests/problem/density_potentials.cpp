// SPDX-License-Identifier: GPL-3.0-or-later
// The problems of potentials of the density as a user runs them: strings and their cure, a drop that
// becomes round and one that does not. Each case is what the other's claim would have to fail for.
#include "problem/found.hpp"
#include "problem/refused.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(strings_form_without_a_core) {
    const Results found("string_phase", {"--core", "0"}, "clumped_fraction");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("clumped_fraction") > 0.55);
}
BOOST_AUTO_TEST_CASE(a_core_keeps_all_particles_apart_wherever_they_start) {
    const Results found("string_phase", {"--core", "0.1", "--seed", "5"}, "clumped_fraction");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("clumped_fraction") == 0.0);
    BOOST_TEST(found.value.at("closest_pair") > 0.55);
}

BOOST_AUTO_TEST_CASE(a_square_drop_stays_square) {
    const Results found("drop", {"--surface-tension", "0"}, "m4");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("m4") > 0.2);
}
BOOST_AUTO_TEST_CASE(surface_tension_makes_it_round) {
    const Results found("drop", {"--surface-tension", "0.1"}, "m4");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("m4") < 0.06);
}

BOOST_AUTO_TEST_CASE(other_cases_claim_nothing) {
    const Results strings("string_phase", {"--smoke"}, "clumped_fraction");
    BOOST_TEST(strings.claims == 0U);
    BOOST_TEST(strings.value.contains("core_clumped_fraction"));
    const Results drop("drop", {"--smoke", "--disorder", "0.1"}, "m4");
    BOOST_TEST(drop.claims == 0U);
    BOOST_TEST(drop.value.contains("tension_m4"));
}

BOOST_AUTO_TEST_CASE(a_drop_that_explodes_fails) {
    const Scratch folder;
    const Outcome outcome =
        run_in(folder, "drop",
               {"--cells", "6", "--surface-tension", "100", "--dt", "0.5", "--t-end", "20"});
    BOOST_TEST(outcome.status == 1);
    // The energy rises, and by more than friction took.
    for (const auto& item : json_of(folder / "out/result.json")) {
        const bool broken = item["name"] == "energy_rise" || item["name"] == "energy_drift";
        BOOST_TEST((item["holds"] == true) == !broken, item.dump());
    }
}

/// Few neighbours within a short range vibrate faster than an integral over them would.
BOOST_AUTO_TEST_CASE(the_step_follows_the_fastest_vibration) {
    const Results found("lattice_stability",
                        {"--smoke", "--range", "1.5", "--cells", "6", "--block", "4"}, "");
    BOOST_TEST(found.value.at("both_fastest_vibration") > 12.0);
    BOOST_TEST(found.value.at("both_energy_drift") < 5e-7);
}

/// A friction that takes less than the steps err by: what energy then rises is not its doing.
BOOST_AUTO_TEST_CASE(next_to_no_friction_claims_nothing_of_the_energy) {
    const Results drop("drop", {"--smoke", "--damping", "1e-6", "--surface-tension", "0.1"},
                       "energy_rise");
    BOOST_TEST(drop.claims == 0U);
    const Results strings("string_phase", {"--smoke", "--damping", "1e-6", "--core", "0"},
                          "energy_rise_per_particle");
    BOOST_TEST(strings.claims == 0U);
    const Results damped("drop", {"--smoke", "--surface-tension", "0.1"}, "energy_rise");
    BOOST_TEST(damped.claims == 1U);
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense_is_refused) {
    check_refused(std::vector<RefusedCall>{
        {"string_phase",
         {"--core", "0", "--core-range", "1"},
         {"core-range: has no meaning for --core 0"}},
        {"string_phase",
         {"--core", "0.1", "--core-range", "4"},
         {"core-range: 4 must lie above 0 and below"}},
        {"string_phase",
         {"--core-range", "1e-300"},
         {"core-range: 1e-300 is below a hundredth of the spacing"}},
        {"string_phase", {"--side", "6"}, {"give more than 7"}},
        {"string_phase",
         {"--side", "7", "--particles", "30"},
         {"side: 7 is too short for --range 3.5"}},
        {"drop",
         {"--core", "0.1", "--core-range", "1e-3"},
         {"core-range: 0.001 is below a hundredth of the spacing"}},
        {"drop", {"--seed", "3"}, {"seed: has no meaning without disorder"}},
        {"drop", {"--core-range", "0.5"}, {"core-range: has no meaning"}},
        {"drop",
         {"--surface-tension", "0.1", "--kernel", "w2"},
         {"a gradient potential needs a weight function"}},
    });
}

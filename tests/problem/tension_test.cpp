// SPDX-License-Identifier: GPL-3.0-or-later
// A bar under tension, as a user runs it: what is known of it and what is refused.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <cmath>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(molecules_part_in_two) {
    const Results found("tension_test", {"--model", "pair_md"}, "load_at_parting");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(std::abs(found.value.at("load_at_parting") - 0.42) < 0.03);
    BOOST_TEST(found.value.at("pieces") >= 2.0);
    BOOST_TEST(found.value.at("second_piece") > 250.0);
    if (!long_runs()) return;  // four times as long
    // Loaded slowly they part where the rows are as strong as their bonds: 5.30/15, and a little later.
    const Results slow("tension_test", {"--model", "pair_md", "--load-rate", "0.001"},
                       "load_at_parting");
    BOOST_TEST(slow.claims == 0U);
    BOOST_TEST(slow.value.at("load_at_parting") > 0.353);
    BOOST_TEST(slow.value.at("load_at_parting") < 0.38);
}

BOOST_AUTO_TEST_CASE(smooth_particles_neck_and_part) {
    const Results found("tension_test", {}, "load_at_parting");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(std::abs(found.value.at("load_at_parting") - 0.0073) < 0.0012);
    BOOST_TEST(found.value.at("pieces") >= 2.0);
    BOOST_TEST(found.value.at("pieces") <= 3.0);
    BOOST_TEST(found.value.at("second_piece") >= 250.0);
    BOOST_TEST(found.value.at("closest_pair") > 0.4);
}

BOOST_AUTO_TEST_CASE(material_vectors_neck_and_part) {
    if (!long_runs()) return;  // ten times as long
    const Results found("tension_test", {"--model", "material_vectors"}, "load_at_parting");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("pieces") == 2.0);
    BOOST_TEST(found.value.at("second_piece") >= 250.0);
    BOOST_TEST(found.value.at("closest_pair") > 0.6);
    BOOST_TEST(found.value.at("momentum_drift") < 1e-13);
    BOOST_TEST(found.value.at("angular_momentum_drift") < 1e-9);
    BOOST_TEST(found.value.at("energy_drift") < 1e-4);
}

BOOST_AUTO_TEST_CASE(material_vectors_that_fly_apart_neck_twice) {
    if (!long_runs()) return;  // pierced_bar breaks material vectors in the short suite
    const Results found("tension_test",
                        {"--model", "material_vectors", "--columns", "50", "--taper", "0",
                         "--disorder", "0", "--end-speed", "0.4", "--yield-stress", "0.03",
                         "--tension-limit", "0.06", "--penalty", "1"},
                        "pieces");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("pieces") == 3.0);
    BOOST_TEST(found.value.at("difference_of_ends") == 0.0);
    BOOST_TEST(found.value.at("closest_pair") > 0.65);
    BOOST_TEST(found.value.at("energy_drift") < 1e-5);
}

BOOST_AUTO_TEST_CASE(smooth_particles_without_a_core_clump_before) {
    const Results found("tension_test", {"--core", "0", "--t-end", "643"}, "pieces");
    BOOST_TEST(found.value.at("closest_pair") < 0.05);  // at loads up to 0.0045
}

// A solid that does not yield bears the load.
BOOST_AUTO_TEST_CASE(a_bar_that_does_not_yield_does_not_part) {
    if (!long_runs()) return;  // the same law once more
    const Results found("tension_test", {"--yield-stress", "10", "--t-end", "800"}, "pieces");
    BOOST_TEST(found.claims == 0U);
    BOOST_TEST(found.value.at("pieces") == 1.0);
    BOOST_TEST(!found.value.contains("load_at_parting"));
}

BOOST_AUTO_TEST_CASE(tests_without_meaning_are_refused) {
    const std::vector<Refused> all{
        {{"--failure-strain", "-1"}, {"failure-strain", "-1", "between"}},
        {{"--yield-stress", "0"}, {"yield-stress", "0", "between"}},
        {{"--hardening", "-0.1"}, {"hardening", "-0.1"}},
        {{"--transport", "monaghan"}, {"transport", "core", "--transport plain"}},
        {{"--core-range", "0.001"}, {"core-range", "between 0.01 and"}},
        {{"--core", "0", "--core-range", "0.7"}, {"core-range", "without a core"}},
        {{"--disorder", "0", "--seed", "2"}, {"seed", "without disorder"}},
        {{"--strength", "0.1"}, {"strength", "--model spam"}},
        {{"--model", "pair_md", "--core", "1"}, {"core", "--model pair_md"}},
        {{"--model", "pair_md", "--range", "3"}, {"range", "--model pair_md"}},
        {{"--model", "embedded_atom", "--transport", "plain"}, {"transport", "embedded_atom"}},
        {{"--model", "embedded_atom", "--yield-stress", "1"}, {"yield-stress", "embedded_atom"}},
        {{"--model", "embedded_atom", "--kernel", "lucy"}, {"kernel", "continuous derivatives"}},
        {{"--model", "springs"}, {"model", "springs", "pair_md"}},
        {{"--tension-limit", "0.1"}, {"tension-limit", "--model spam"}},
        {{"--end-speed", "0.4"}, {"end-speed", "--model spam"}},
        {{"--model", "material_vectors", "--hardening", "0.1"}, {"hardening", "material_vectors"}},
        {{"--model", "material_vectors", "--kernel", "w5"}, {"kernel", "material_vectors"}},
        {{"--model", "material_vectors", "--end-speed", "0.4", "--damping", "0.1"},
         {"damping", "end-speed"}},
        {{"--taper", "0.6"}, {"taper", "0.6", "between 0 and 0.5"}},
        {{"--load-rate", "0"}, {"load-rate", "0", "between"}},
        {{"--damping", "100", "--dt", "0.05"}, {"dt", "damping", "smaller --dt"}},
        {{"--columns", "4"}, {"columns", "4", "between 8 and"}},
    };
    check_refused("tension_test", all);
}

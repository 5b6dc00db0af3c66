// SPDX-License-Identifier: GPL-3.0-or-later
// A column of water at rest and on its way, as a user runs it: what is known of it and what is refused.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <cmath>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(a_column_at_rest) {
    const Results found("water_column", {"--width", "8", "--t-end", "4"}, "profile_error");
    BOOST_TEST(found.value.at("profile_error") < 0.01);
    BOOST_TEST(std::abs(found.value.at("floor_force") - 1.0) < 0.02);
}

BOOST_AUTO_TEST_CASE(the_column_of_the_lecture) {
    if (!long_runs()) return;  // above, narrower
    const Results found("water_column", {}, "front_at_80");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("profile_error") < 0.006);
    BOOST_TEST(std::abs(found.value.at("floor_force") - 1.0) < 0.01);
    BOOST_TEST(std::abs(found.value.at("front_at_40") - 33.6) < 1.0);
    BOOST_TEST(std::abs(found.value.at("front_at_80") - 57.2) < 2.5);
    BOOST_TEST(found.value.at("leading_percent_at_80") < found.value.at("front_at_80"));
}

BOOST_AUTO_TEST_CASE(a_dam_of_water_is_as_fast_in_the_end) {
    if (!long_runs()) return;  // the fluid of the case above from another height
    const Results found("water_column", {"--aspect", "2"}, "difference_from_water");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(std::abs(found.value.at("difference_from_water")) < 0.06);
    const Results stiff("water_column", {"--aspect", "2", "--gravity", "0.1"},
                        "difference_from_water");
    BOOST_TEST(stiff.claims == 0U);
    BOOST_TEST(stiff.value.at("largest_difference_from_water") < 0.12);
    BOOST_TEST(found.value.at("largest_difference_from_water") >
               stiff.value.at("largest_difference_from_water"));
}

// Samples rest a little shorter or longer, and are otherwise what a run with that relaxation time is.
BOOST_AUTO_TEST_CASE(fronts_of_samples_are_averaged) {
    const Words small{"--width", "8", "--gravity", "0.4", "--t-end", "25"};
    const auto front = [&](const char* relaxation_time) {
        Words words = small;
        words.insert(words.end(), {"--relaxation-time", relaxation_time});
        return Results("water_column", words, "front_at_20").value.at("front_at_20");
    };
    Words words = small;
    words.insert(words.end(), {"--relaxation-time", "20", "--samples", "3"});
    const Results found("water_column", words, "front_at_20");
    const double one[] = {front("20"), front("19.8"), front("20.2")};
    BOOST_TEST(found.value.at("front_at_20") == one[0]);
    const double mean = (one[0] + one[1] + one[2]) / 3.0;
    double squares = 0.0;
    for (const double each : one) squares += (each - mean) * (each - mean);
    BOOST_TEST(squares > 0.0);
    BOOST_TEST(std::abs(found.value.at("mean_front_at_20") - mean) < 1e-9);
    BOOST_TEST(std::abs(found.value.at("deviation_of_front_at_20") - std::sqrt(squares / 2.0)) <
               1e-9);
}

// What other fluids do is claimed nowhere, and what they conserve everywhere.
BOOST_AUTO_TEST_CASE(a_limited_tension_keeps_the_energy) {
    const Results found("water_column", {"--cavitation", "0.02", "--width", "8"}, "front_at_40");
    BOOST_TEST(found.claims == 0U);
    BOOST_TEST(found.value.at("relaxation_energy_drift") < 1e-4);
    BOOST_TEST(found.value.at("collapse_energy_drift") < 1e-4);
}

BOOST_AUTO_TEST_CASE(columns_without_meaning_are_refused) {
    const std::vector<Refused> all{
        {{"--width", "4", "--range", "5"}, {"width: 4", "range 5", "larger --width"}},
        {{"--width", "2"}, {"width", "2", "between 4 and 400"}},
        {{"--width", "16.5"}, {"width", "16.5"}},
        {{"--aspect", "0.15"}, {"aspect", "2.4", "range 3", "larger --aspect"}},
        {{"--samples", "0"}, {"samples", "0", "between 1 and 25"}},
        {{"--samples", "2.5"}, {"samples", "2.5"}},
        {{"--aspect", "-2"}, {"aspect", "-2"}},
        {{"--gravity", "0"}, {"gravity", "0", "between 0.01 and 2"}},
        {{"--range", "1"}, {"range: 1", "above the particle spacing"}},
        {{"--relaxation-time", "0"}, {"relaxation-time", "0", "between"}},
        {{"--damping", "-0.1"}, {"damping", "-0.1"}},
        {{"--damping", "100", "--dt", "0.05"}, {"dt", "damping", "smaller --dt"}},
        {{"--cavitation", "0.2"}, {"cavitation", "0.2", "0.148"}},
        {{"--surface-tension", "-1"}, {"surface-tension", "-1"}},
        {{"--kernel", "w2"}, {"kernel", "continuous derivatives"}},
        {{"--core", "0", "--core-range", "0.8"}, {"core-range", "without a core"}},
        {{"--core-range", "0.001"}, {"core-range", "hundredth"}},
        {{"--core-range", "3.5"}, {"core-range", "3.5", "range 3"}},
        {{"--output-every", "1e-300"}, {"output-every"}},
    };
    check_refused("water_column", all);
}

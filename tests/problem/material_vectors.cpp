// SPDX-License-Identifier: GPL-3.0-or-later
// Material vectors as a user runs them: what stability says, what the study measures, configurations of
// thousand_turns, and the warning of a run whose tension is too large for its penalty.
#include "problem/found.hpp"

#include <cmath>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(stability_of_several_penalties) {
    const Results found("stability", {"--formulation", "material_vectors", "--cells", "12"},
                        "penalty_1_growth_rate");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("penalty_1_growth_rate") == 0.0);
    BOOST_TEST(found.value.at("penalty_0_growth_rate") >
               0.1);  // of the same scheme without penalty
    BOOST_TEST(std::abs(found.value.at("no_memory_growth_rate_on_path") - 0.1010) < 5e-4);
    BOOST_TEST(std::abs(found.value.at("penalty_1_lowest_frequency_by_elastic") - 0.392) < 0.02);
    // Nothing is claimed of a penalty that is too small.
    const Results strained("stability",
                           {"--formulation", "material_vectors", "--penalty", "0.3", "--stress",
                            "0.3", "--shear-stress", "0.1", "--cells", "12"},
                           "growth_rate");
    BOOST_TEST(strained.claims == 0U);
    BOOST_TEST(std::abs(strained.value.at("growth_rate_on_path") - 0.62) < 0.02);
}

BOOST_AUTO_TEST_CASE(what_the_study_measures) {
    const Results found("material_vectors_study", {"--smoke"}, "beam_error");
    BOOST_TEST(std::abs(found.value.at("tension_borne") - 1.04) < 0.03);
    BOOST_TEST(std::abs(found.value.at("beam_error") + 0.0258) < 1e-3);  // 6 rows
    BOOST_TEST(found.value.at("hexagon_closest_pair") > 0.9);
    BOOST_TEST(std::abs(found.value.at("disorder_error")) < 0.2);
    BOOST_TEST(std::abs(found.value.at("lowest_frequency") - 0.551) < 0.01);
}

BOOST_AUTO_TEST_CASE(configurations_after_so_many_turns) {
    const Scratch folder;
    const Outcome outcome = run_in(folder, "thousand_turns", {"--smoke"});
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    const Csv table(folder / "out/thousand_turns.csv");
    BOOST_TEST(table.column("turns_survived").front() == 2.0);
    for (const char* turns : {"0.002", "0.02", "0.2", "2"}) {
        const Csv configuration(folder /
                                ("out/material_vectors_" + std::string(turns) + "_turns.csv"));
        BOOST_TEST(configuration.column("velocity_x").size() == 19U);
    }
}

BOOST_AUTO_TEST_CASE(tension_beyond_what_the_penalty_keeps_stable) {
    for (const char* penalty : {"0.1", "2"}) {
        const Scratch folder;
        const Outcome outcome = run_in(folder, "rotating_hexagon",
                                       {"--formulation", "material_vectors", "--speed", "0.6",
                                        "--t-end", "12", "--penalty", penalty});
        BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
        const bool warned = outcome.out.find("tension above the 0.0873") != std::string::npos;
        const bool noted = std::filesystem::exists(folder / "out/events.csv");
        BOOST_TEST(warned == (penalty == std::string("0.1")));
        BOOST_TEST(noted == warned);
        if (noted)
            BOOST_TEST(
                contents_of(folder / "out/events.csv")
                    .find("tension above the 0.0873 that penalty kappa = 0.1 keeps stable") !=
                std::string::npos);
    }
}

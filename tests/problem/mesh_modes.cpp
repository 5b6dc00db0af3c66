// SPDX-License-Identifier: GPL-3.0-or-later
// The butterfly and the hourglass as a user meets them: three motions that cost nothing, and what brakes them.
#include "problem/found.hpp"

#include <boost/test/unit_test.hpp>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(three_motions_cost_nothing) {
    const Results found("mesh_modes", {}, "zero_modes_4");
    BOOST_TEST(found.claims == 1U);
    for (int n = 1; n <= 8; ++n)
        BOOST_TEST(found.value.at("zero_modes_" + std::to_string(n)) == (n == 1 ? 2.0 : 3.0));
    BOOST_TEST(found.value.at("gap_of_singular_values") > 1e9);
    for (const char* mode : {"hourglass_x", "hourglass_y", "butterfly"}) {
        const std::string name = mode;
        BOOST_TEST(found.value.at(name + "_stress_rate") <= 1e-14);
        BOOST_TEST(found.value.at(name + "_free_kinetic_change") <= 1e-14);
        BOOST_TEST(found.value.at(name + "_resisted_kinetic_left") < 1e-3);
    }
}

BOOST_AUTO_TEST_CASE(one_element_cannot_turn_against_another) {
    const Results found("mesh_modes", {"--elements", "1", "--t-end", "5"}, "zero_modes_1");
    BOOST_TEST(found.value.contains("hourglass_x_free_kinetic_change"));
    BOOST_TEST(!found.value.contains("butterfly_free_kinetic_change"));
}

/// What is not resisted stays, and nothing is claimed of it.
BOOST_AUTO_TEST_CASE(without_resistance_nothing_is_gone) {
    const Results found("mesh_modes", {"--hourglass-viscosity", "0"},
                        "hourglass_x_resisted_kinetic_left");
    BOOST_TEST(found.claims == 0U);
    BOOST_TEST(std::abs(found.value.at("hourglass_x_resisted_kinetic_left") - 1.0) < 1e-14);
    const Results stiff("mesh_modes",
                        {"--hourglass-viscosity", "0", "--hourglass-stiffness", "0.1"},
                        "hourglass_x_resisted_kinetic_left");
    BOOST_TEST(stiff.value.at("hourglass_x_resisted_kinetic_left") < 1.0);
}

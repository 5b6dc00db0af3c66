// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that rotate in space: balanced torques keep the vector L, and a block tumbles as Jacobi says. A cloud of gas
// that flies apart.
#include "problem/found.hpp"

#include <boost/test/unit_test.hpp>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(balanced_torques_keep_the_vector_of_a_cube) {
    const Results found("rotating_body", {"--angular-momentum", "torque_pair", "--dt", "0.25"},
                        "angular_momentum_change");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("newton_sums_by_rate") <= 5.0);
}

BOOST_AUTO_TEST_CASE(without_them_most_of_it_is_lost) {
    const Results found("rotating_body", {"--turns", "0.34"},
                        "angular_momentum_ratio_at_0.331_turns");
    BOOST_TEST(std::abs(found.value.at("angular_momentum_ratio_at_0.331_turns") - 0.366) < 0.01);
}

/// Smooth in space, unlike in the plane: the order of RK4 is there, and more.
BOOST_AUTO_TEST_CASE(torques_of_particles_keep_the_order_of_the_method) {
    double before = 0.0;
    for (const char* dt : {"0.5", "0.25", "0.125"}) {
        const Results found(
            "rotating_body",
            {"--angular-momentum", "torque_particle", "--turns", "0.25", "--dt", dt},
            "energy_change");
        const double change = found.value.at("energy_change");
        if (before > 0.0) BOOST_TEST(before / change > 20.0);
        before = change;
    }
}

BOOST_AUTO_TEST_CASE(a_block_changes_its_axis_when_jacobi_says) {
    const Results found("rotating_body",
                        {"--body", "block", "--formulation", "total_lagrangian", "--speed", "0.1"},
                        "flips");
    BOOST_TEST(found.claims == 1U);
    // 14.338 and twice that for a rigid block; elasticity makes it half a percent later at this speed.
    BOOST_TEST(std::abs(found.value.at("flip_1") - 14.338) < 0.1);
    BOOST_TEST(std::abs(found.value.at("flip_3") - found.value.at("flip_2") - 28.676) < 0.2);
    BOOST_TEST(found.value.at("flip_deviation") > 0.004);
}

/// Dyson's exact solution, in the plane and in space: what another program found is within 1 % of the axes.
BOOST_AUTO_TEST_CASE(a_cloud_turns_inside_out_as_dyson_says) {
    const Results space("gas_cloud", {"--axes", "4,2,1"}, "axis_1_error_percent");
    BOOST_TEST(space.claims == 1U);
    const Results own("gas_cloud", {"--dimension", "2", "--ranges", "density"},
                      "axis_2_error_percent");
    BOOST_TEST(own.claims == 1U);
    BOOST_TEST(std::abs(own.value.at("axis_2_error_percent")) <
               0.3 * std::abs(space.value.at("axis_3_error_percent")));
    // An ellipse that is a circle stays one, and another one comes back to where it was.
    const Results round("gas_cloud", {"--dimension", "2", "--axes", "1,1", "--size", "8"},
                        "axis_1");
    BOOST_TEST(std::abs(round.value.at("axis_1") - round.value.at("axis_2")) < 1e-10);
    const Results back("gas_cloud", {"--dimension", "2", "--return"}, "axis_1_back");
    BOOST_TEST(back.claims == 1U);
}

/// Of the defect nothing is left but what one section says.
BOOST_AUTO_TEST_CASE(columns_twist_as_much_more_easily_as_derived) {
    const Results found("torsion", {"--compare"}, "n6_less_than_derived_percent");
    BOOST_TEST(found.claims == 1U);
    for (const auto& [n, percent] :
         {std::pair{"n4", -21.9}, std::pair{"n6", -12.7}, std::pair{"n8", -8.2}}) {
        const double error = found.value.at(std::string(n) + "_frequency_error_percent");
        BOOST_TEST(std::abs(error - percent) < 0.2);
        BOOST_TEST(std::abs(found.value.at(std::string(n) + "_less_than_derived_percent")) < 0.1);
    }
}

/// Also the one on a narrow ridge that a coarse grid misses.
BOOST_AUTO_TEST_CASE(the_fastest_wave_of_a_cubic_lattice_is_found) {
    const Results found(
        "stability",
        {"--dimension", "3", "--lattice", "bcc", "--transport", "monaghan", "--stress", "0.01"},
        "monaghan_0.01_growth_rate");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(!found.value.contains("plain_0.01_growth_rate"));
    const Results one(
        "stability",
        {"--dimension", "3", "--transport", "plain", "--stress", "0.01", "--range", "2"},
        "plain_0.01_growth_rate");
    BOOST_TEST(one.claims == 1U);
}

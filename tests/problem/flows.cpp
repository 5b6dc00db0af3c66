// SPDX-License-Identifier: GPL-3.0-or-later
// Flows with known answers as a user runs them: plates, a shock, a gas between mirrors.
#include "problem/found.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(couette_flow_is_linear) {
    const Results found("couette", {}, "profile_error");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("profile_error") < 0.005);
    BOOST_TEST(found.value.at("largest_profile_error") < 0.03);
}
BOOST_AUTO_TEST_CASE(poiseuille_flow_is_a_parabola) {
    const Results found("poiseuille", {}, "profile_error");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("mean_velocity") > 0.66);
}

// What pairs are for: by gradients particles lose their order, and nothing is claimed.
BOOST_AUTO_TEST_CASE(friction_by_gradients_is_worse) {
    if (!effort(true, false)) return;  // smoke runs have it
    const Results found("couette", {"--friction", "gradients"}, "profile_error");
    BOOST_TEST(found.claims == 0U);
    BOOST_TEST(found.value.at("profile_error") > 0.02);
}

BOOST_AUTO_TEST_CASE(a_shock_tube_converges_to_the_exact_solution) {
    const Results found("shock_tube", {}, "order");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("order") > 0.8);
    BOOST_TEST(found.value.at("1600_density_error") < 0.0025);
    const Results other("shock_tube", {"--gamma", "1.67", "--cells", "200", "--single"},
                        "pressure");
    BOOST_TEST(other.claims == 0U);
}

BOOST_AUTO_TEST_CASE(mirrors_act_like_periods_on_an_expanding_gas) {
    const Words gas{"--cells", "32", "--t-end", "48", "--walls"};
    const auto expanded = [&](const char* walls) {
        Words arguments = gas;
        arguments.emplace_back(walls);
        return Results("free_expansion", arguments, "entropy_grid").value.at("entropy_grid");
    };
    BOOST_TEST(std::abs(expanded("mirror") - expanded("periodic")) < 0.03);
}

// With the step of the standard plates the energy changes by 1.4e-4 of itself.
BOOST_AUTO_TEST_CASE(the_step_follows_the_hotter_plate) {
    const Results found(
        "rayleigh_benard",
        {"--height", "10", "--bottom", "no-slip@20", "--top", "no-slip@0.1", "--t-end", "120"},
        "energy_drift");
    BOOST_TEST(found.value.at("energy_drift") < 2e-5);
}

BOOST_AUTO_TEST_CASE(a_layer_heated_from_below_rolls_as_finite_differences_do) {
    const Results found("rayleigh_benard", {"--t-end", "1000"}, "nusselt_by_grid");
    BOOST_TEST(std::abs(found.value.at("nusselt_by_grid") - 1.0) < 0.1);
    BOOST_TEST(std::abs(found.value.at("nusselt_difference")) < 0.1);
    BOOST_TEST(found.value.at("nusselt_bottom") > 1.5);
    BOOST_TEST(found.value.at("energy_drift") < 1e-6);
    if (!effort(true, false)) return;  // the same law once more
    const Results quiet("rayleigh_benard", {"--rayleigh", "1000", "--t-end", "600"}, "roll_left");
    BOOST_TEST(quiet.value.at("roll_left") < 0.1);
}

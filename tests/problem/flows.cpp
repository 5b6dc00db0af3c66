// SPDX-License-Identifier: GPL-3.0-or-later
// Flows with known answers as a user runs them: plates, a shock, a gas between mirrors. Under sanitizers, where some
// take minutes, smoke runs go the same ways.
#include "problem/found.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam::test;

// Plates hold what the flow drags along: eta V/H; half of the force that drives it.
BOOST_AUTO_TEST_CASE(couette_flow_is_linear) {
    const Results found("couette", {}, "profile_error");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("profile_error") < 0.005);
    BOOST_TEST(found.value.at("largest_profile_error") < 0.03);
    for (const char* plate : {"stress_bottom", "stress_top"})
        BOOST_TEST(std::abs(found.value.at(plate) - 1.0) < 0.01);
}
BOOST_AUTO_TEST_CASE(poiseuille_flow_is_a_parabola) {
    if (!long_runs()) return;  // smoke runs have it, and plates that move the same law
    const Results found("poiseuille", {}, "profile_error");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("mean_velocity") > 0.66);
    for (const char* plate : {"stress_bottom", "stress_top"})
        BOOST_TEST(std::abs(found.value.at(plate) - 1.0) < 0.01);
}

// What pairs are for: by gradients particles lose their order, and nothing is claimed.
BOOST_AUTO_TEST_CASE(friction_by_gradients_is_worse) {
    if (!long_runs()) return;  // smoke runs have it
    const Results found("couette", {"--friction", "gradients"}, "profile_error");
    BOOST_TEST(found.claims == 0U);
    BOOST_TEST(found.value.at("profile_error") > 0.02);
}

BOOST_AUTO_TEST_CASE(a_shock_tube_converges_to_the_exact_solution) {
    if (SPAM_SANITIZED) return;
    const Results found("shock_tube", {}, "order");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("order") > 0.8);
    BOOST_TEST(found.value.at("1600_density_error") < 0.0025);
    const Results other("shock_tube", {"--gamma", "1.67", "--cells", "200", "--single"},
                        "pressure");
    BOOST_TEST(other.claims == 0U);
}

// The third and the fourth have pressures 100,000 and 10,000 to 1. In the second, nearly a vacuum, the middle is
// too thin for a plateau.
BOOST_AUTO_TEST_CASE(all_five_of_toros_tests_reach_their_end_by_the_own_work) {
    for (const char* number : {"1", "2", "3", "4", "5"}) BOOST_TEST_CONTEXT("test " << number) {
            const bool thin = number == std::string("2");
            if (!long_runs() && number != std::string("3")) continue;
            const Results found("shock_tube", {"--toro", number, "--single"}, "pressure");
            BOOST_TEST(found.claims == (thin ? 0U : 1U));
        }
}

// By the mean work a cold particle would give heat that it has not: also where stages that follow meet no numbers
// the reason names it.
BOOST_AUTO_TEST_CASE(the_mean_work_takes_heat_that_cold_particles_do_not_have) {
    for (const Words& integrator :
         {Words{}, Words{"--integrator", "arkode:BOGACKI_SHAMPINE_4_2_3"}}) {
        Words arguments{"--toro", "3", "--single", "--cells", "100", "--work", "mean"};
        arguments.insert(arguments.end(), integrator.begin(), integrator.end());
        const Scratch folder;
        const Outcome outcome = run_in(folder, "shock_tube", arguments);
        BOOST_TEST(outcome.status == 3);
        BOOST_TEST((outcome.out + outcome.err).find("outside the law (perfect gas") !=
                   std::string::npos);
        BOOST_TEST((outcome.out + outcome.err).find("not finite") == std::string::npos);
    }
}

// Sedov's radius: within 3 % at the coarser of the two resolutions of --compare, half as much again with a half of
// its particles; and other gases.
BOOST_AUTO_TEST_CASE(a_blast_runs_like_sedovs) {
    const Results found(
        "blast", effort(Words{"--single", "--cells", "32"}, Words{"--smoke", "--single"}),
        effort<const char*>("front", "energy_change"));  // smoke runs end before it is one
    BOOST_TEST(found.value.at("least_energy_ratio") > 0.9);
    if (effort(true, false)) BOOST_TEST(std::abs(found.value.at("front") / 0.8 - 1.0) < 0.05);
    if (!long_runs()) return;
    BOOST_TEST(Results("blast", {"--single"}, "front").claims == 1U);
    const Results other("blast", {"--gamma", "1.2", "--single", "--cells", "32"}, "front");
    BOOST_TEST(std::abs(other.value.at("front") / 0.8 - 1.0) < 0.06);
}

BOOST_AUTO_TEST_CASE(mirrors_act_like_periods_on_an_expanding_gas) {
    if (SPAM_SANITIZED) return;
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

/// Sides drawn at random found these two: particles passed each other within a step.
BOOST_AUTO_TEST_CASE(the_step_follows_the_fastest_side) {
    for (const auto& [program, words] :
         {std::pair<const char*, Words>{
              "poiseuille",
              {"--cells", "8", "--smoke", "--left", "mirror", "--right", "moving:1e-300",
               "--bottom", "moving:5", "--top", "mirror", "--friction", "pairs", "--kernel", "w6"}},
          {"rayleigh_benard",
           {"--smoke", "--left", "no-slip@1.5", "--right", "moving:5", "--rayleigh", "1000"}}}) {
        const Results found(program, words, "energy_drift");
        BOOST_TEST(found.value.at("energy_drift") < 2e-5);
    }
}

BOOST_AUTO_TEST_CASE(a_layer_heated_from_below_rolls_as_finite_differences_do) {
    if (SPAM_SANITIZED) return;
    // At 700 rolls are whole, at 500 they are not.
    const char* const t_end = long_runs() ? "1000" : "750";
    const Results found("rayleigh_benard", {"--t-end", t_end}, "nusselt_by_grid");
    BOOST_TEST(std::abs(found.value.at("nusselt_by_grid") - 1.0) < 0.1);
    BOOST_TEST(std::abs(found.value.at("nusselt_difference")) < 0.1);
    BOOST_TEST(found.value.at("nusselt_bottom") > 1.5);
    BOOST_TEST(found.value.at("energy_drift") < 1e-6);
    if (!long_runs()) return;  // the same law once more
    const Results quiet("rayleigh_benard", {"--rayleigh", "1000", "--t-end", "600"}, "roll_left");
    BOOST_TEST(quiet.value.at("roll_left") < 0.1);
}

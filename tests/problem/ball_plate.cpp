// SPDX-License-Identifier: GPL-3.0-or-later
// A ball that hits a plate, as a user runs it: what is known of it and what is refused.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <cmath>

using namespace spam::test;

namespace {

double value_of(const Words& arguments, const char* name) {
    return Results("ball_plate", arguments, name).value.at(name);
}

}  // namespace

BOOST_AUTO_TEST_CASE(molecules_break_into_more_pieces_the_faster_they_are) {
    const Results found("ball_plate", {"--model", "pair_md", "--compare"}, "v_4_pieces");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("v_1_pieces") == 1.0);
    BOOST_TEST(found.value.at("v_2_pieces") >= 2.0);
    BOOST_TEST(found.value.at("v_2_pieces") <= 5.0);
    BOOST_TEST(std::abs(found.value.at("v_4_pieces") - 35.0) < 11.0);
    BOOST_TEST(std::abs(found.value.at("v_8_pieces") - 140.0) < 26.0);
    for (const char* name : {"v_1_energy_drift", "v_8_energy_drift"})
        BOOST_TEST(found.value.at(name) < 1e-6);
}

BOOST_AUTO_TEST_CASE(embedded_atoms_keep_half_of_their_speed_and_more) {
    const Results found("ball_plate", {"--model", "embedded_atom"}, "ball_speed");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(std::abs(found.value.at("ball_speed") - 0.606) < 0.02);
}

// One run depends on its last digits; the mean of five does not.
BOOST_AUTO_TEST_CASE(slow_balls_of_embedded_atoms_in_the_mean) {
    if (!long_runs()) return;  // the same law five times more
    double sum = 0.0;
    for (const char* seed : {"1", "2", "3", "4", "5"})
        sum +=
            value_of({"--model", "embedded_atom", "--speed", "0.25", "--seed", seed}, "ball_speed");
    BOOST_TEST(std::abs(sum / 5.0 - 0.148) < 0.01);
}

BOOST_AUTO_TEST_CASE(smooth_particles_keep_as_much_as_in_another_program) {
    for (const auto& [speed, ball_speed] :
         {std::pair{"0.25", 0.108}, {"0.5", 0.314}, {"1", 0.585}, {"2", 1.16}}) {
        const Results found("ball_plate", {"--speed", speed}, "ball_speed");
        BOOST_TEST(found.claims == 1U);
        BOOST_TEST(found.value.at("ball_speed") == ball_speed, boost::test_tools::tolerance(0.03));
        BOOST_TEST(found.value.at("energy_drift") < 1e-4);
    }
}

// Nothing holds on to the ball, which keeps more of its speed than one that sticks to the plate.
BOOST_AUTO_TEST_CASE(a_contact_in_place_of_adhesion) {
    const double sticking = value_of({"--speed", "0.25"}, "ball_speed"),
                 touching = value_of({"--speed", "0.25", "--contact", "repulsive"}, "ball_speed");
    BOOST_TEST(touching == 0.116, boost::test_tools::tolerance(0.05));
    BOOST_TEST(touching > sticking);
}

// Particles at the ends stay where they are.
BOOST_AUTO_TEST_CASE(ends_that_are_held) {
    const Words slow{"--radius", "3", "--columns", "20", "--rows", "3", "--speed", "0.25"};
    Words held = slow;
    held.insert(held.end(), {"--ends", "held"});
    const double free = value_of(slow, "ball_speed"), stopped = value_of(held, "ball_speed");
    BOOST_TEST(free > 0.0);
    BOOST_TEST(stopped < 0.7 * free);
}

BOOST_AUTO_TEST_CASE(impacts_without_meaning_are_refused) {
    const std::vector<Refused> all{
        {{"--failure-strain", "0"}, {"failure-strain", "0", "between"}},
        {{"--contact", "repulsive", "--contact-range", "1.2"}, {"contact-range: 1.2", "spacing"}},
        {{"--contact", "repulsive", "--contact-range", "1e-9"},
         {"contact-range: 1e-09", "half the spacing", "pass between"}},
        {{"--contact-range", "0.9"}, {"contact-range", "without a contact"}},
        {{"--contact-energy", "2"}, {"contact-energy", "without a contact"}},
        {{"--contact", "repulsive", "--contact-energy", "-1"}, {"contact-energy", "-1"}},
        {{"--contact", "glue"}, {"contact", "glue", "repulsive"}},
        {{"--contact", "none", "--model", "elements"}, {"contact", "--model elements"}},
        {{"--transport", "average"}, {"transport", "core", "--transport plain"}},
        {{"--compare", "--speed", "2"}, {"speed", "compare"}},
        {{"--speed", "0"}, {"speed", "0", "between"}},
        {{"--gap", "0"}, {"gap", "0", "between 0.5"}},
        {{"--ends", "glued"}, {"ends", "glued", "held"}},
        {{"--model", "all"}, {"model", "all", "spam"}},
        {{"--model", "elements", "--seed", "2"}, {"seed", "--model elements"}},
        {{"--model", "pair_md", "--viscosity", "1"}, {"viscosity", "--model pair_md"}},
    };
    check_refused("ball_plate", all);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that touch and part, as a user runs them.
#include "problem/found.hpp"
#include "problem/refused.hpp"

#include <cmath>

using namespace spam::test;

namespace {

const Words small{"--radius", "8", "--inner-radius", "5", "--t-end", "200"};

Words with(const Words& more) {
    Words all = small;
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(rings_part_as_in_another_program) {
    const Results found("colliding_rings", {}, "parting_speed");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(std::abs(found.value.at("parting_speed") - 0.0394) < 0.002);
    BOOST_TEST(found.value.at("contact_energy_at_end") == 0.0);
    BOOST_TEST(found.value.at("closest_contact") > 0.5);
    BOOST_TEST(found.value.at("largest_contact_energy") > 0.01);
    BOOST_TEST(found.value.at("smallest_separation") < 22.0);  // of 34: they are bent
}

BOOST_AUTO_TEST_CASE(rings_of_either_formulation_part_again) {
    for (const char* formulation : {"total_lagrangian", "updated", "material_vectors"}) {
        const Results found("colliding_rings", with({"--formulation", formulation}), "restitution");
        BOOST_TEST(found.claims == 0U);
        BOOST_TEST(found.value.at("parted_at") > 20.0);
        BOOST_TEST(found.value.at("restitution") > 0.5);
        BOOST_TEST(found.value.at("restitution") < 1.0);
        BOOST_TEST(found.value.at("pieces") == 2.0);
        BOOST_TEST(found.value.at("energy_drift") < 1e-6);
    }
}

// Off the line of centres they begin to turn: all of it stays in the sum.
BOOST_AUTO_TEST_CASE(rings_that_meet_off_their_line_keep_the_angular_momentum) {
    const Results found("colliding_rings", with({"--offset", "6"}), "restitution");
    BOOST_TEST(found.value.at("angular_momentum_drift") < 1e-9);
    BOOST_TEST(found.value.at("momentum_drift") < 1e-13);
    BOOST_TEST(found.value.at("parted_at") > 20.0);
}

BOOST_AUTO_TEST_CASE(a_sheet_that_is_crushed_folds_and_does_not_stick) {
    const Results found("crushed_sheet", {}, "contact_energy_at_end");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("closest_contact") > 0.69);
    BOOST_TEST(found.value.at("largest_contact_energy") > 1e-3);
    BOOST_TEST(found.value.at("contact_energy_at_end") == 0.0);
    BOOST_TEST(found.value.at("energy_less_wall_work") < 1e-5);
    BOOST_TEST(found.value.at("shortest_length") < 11.0);
    BOOST_TEST(found.value.at("height") > 10.0);
    BOOST_TEST(found.value.at("closest_pair") > 0.25);
    BOOST_TEST(found.value.at("plastic_work") > 0.5 * found.value.at("wall_work"));
    BOOST_TEST(found.value.at("plastic_work") < found.value.at("wall_work"));
}

// An elastic one springs back.
BOOST_AUTO_TEST_CASE(a_sheet_that_does_not_yield_keeps_no_fold) {
    const Results found("crushed_sheet", {"--yield-stress", "10", "--columns", "40"}, "height");
    BOOST_TEST(found.value.at("plastic_work") == 0.0);
    BOOST_TEST(found.value.at("height") > 36.0);  // straight again, across the walls
    BOOST_TEST(found.value.at("energy_drift") < 1e-4);
    BOOST_TEST(found.value.at("angular_momentum_drift") < 1e-7);
}

BOOST_AUTO_TEST_CASE(contacts_without_meaning_are_refused) {
    const std::vector<Refused> all{
        {{"--contact-range", "1.2"}, {"contact-range: 1.2", "not above the spacing"}},
        {{"--contact-range", "1e-9"}, {"contact-range: 1e-09", "half the spacing"}},
        {{"--contact-energy", "0"}, {"contact-energy", "between"}},
        {{"--inner-radius", "15.9"}, {"inner-radius", "no ring"}},
        {{"--inner-radius", "17"}, {"inner-radius", "no ring"}},
        {{"--range", "1"}, {"range: '1'"}},
        {{"--penalty", "1", "--formulation", "updated"}, {"penalty", "updated"}},
        {{"--viscosity", "-1"}, {"viscosity", "between"}},
    };
    check_refused("colliding_rings", all);
}

BOOST_AUTO_TEST_CASE(a_sheet_without_room_is_refused) {
    for (const Words& bad : {Words{"--width", "61"}, Words{"--columns", "12", "--width", "13"}}) {
        const Scratch folder;
        const Outcome outcome = run_in(folder, "crushed_sheet", bad);
        BOOST_TEST(outcome.status == 2);
        BOOST_TEST(outcome.err.find("width: the walls begin") != std::string::npos, outcome.err);
        BOOST_TEST(folder.listing().empty());
    }
}

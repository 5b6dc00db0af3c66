// SPDX-License-Identifier: GPL-3.0-or-later
// A projectile and a bar that flows and breaks, as a user runs them: what is kept, and what is refused.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <cmath>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(a_projectile_goes_through_a_bar) {
    const Words smaller = effort(Words{}, Words{"--smoke"});
    const Results found("pierced_bar", smaller, "spin_change_of_pieces");
    BOOST_TEST(found.claims == effort(1U, 0U));
    BOOST_TEST(found.value.at("momentum_change") < 1e-13);
    BOOST_TEST(found.value.at("angular_momentum_change") < 1e-9);
    BOOST_TEST(found.value.at("energy_change") < 1e-5);
    BOOST_TEST(found.value.at("plastic_heat") > 0.1);
    BOOST_TEST(found.value.at("closest_pair") > 0.4);
    if (!effort(true, false)) return;
    BOOST_TEST(found.value.at("pieces") >= 4.0);
    BOOST_TEST(found.value.at("longest_flight") > 60.0);
    BOOST_TEST(found.value.at("largest_angle") > 0.3);
}

// The bar of the paper: no body loses angular momentum, without a balance of torques.
BOOST_AUTO_TEST_CASE(bodies_of_the_paper_s_bar_keep_their_angular_momentum) {
    const Results found("fragmenting_bar", {"--smoke", "--compare"},
                        "material_vectors_angular_momentum_change_of_bodies");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(found.value.at("plain_angular_momentum_change_of_bodies") > 1e-3);
    BOOST_TEST(found.value.at("material_vectors_angular_momentum_change_of_bodies") < 1e-7);
    BOOST_TEST(found.value.at("material_vectors_energy_drift") < 1e-5);
}

BOOST_AUTO_TEST_CASE(shots_without_meaning_are_refused) {
    const std::vector<RefusedCall> all{
        {"pierced_bar", {"--speed", "200"}, {"speed: at 200", "dt = 0.025", "--dt below"}},
        {"pierced_bar", {"--range", "0.9"}, {"range: '0.9'"}},
        {"pierced_bar", {"--core", "0", "--core-range", "0.7"}, {"core-range", "without a core"}},
        {"pierced_bar", {"--core-range", "0.001"}, {"core-range", "between 0.01 and"}},
        {"pierced_bar",
         {"--contact", "none", "--contact-energy", "2"},
         {"contact-energy", "--contact repulsive"}},
        {"pierced_bar", {"--contact-range", "1e-9"}, {"contact-range: 1e-09", "half the spacing"}},
        {"pierced_bar",
         {"--contact-range", "1.5"},
         {"contact-range: 1.5", "not above the spacing"}},
        {"pierced_bar", {"--tension-limit", "0"}, {"tension-limit", "between"}},
        {"pierced_bar", {"--stretch-limit", "1"}, {"stretch-limit", "above 1"}},
        {"pierced_bar", {"--bond-yield", "-1"}, {"bond-yield", "between 0 and"}},
        {"pierced_bar", {"--columns", "1"}, {"columns", "between 2 and 200"}},
        {"fragmenting_bar", {"--yield-stress", "1"}, {"yield-stress", "material_vectors"}},
        {"fragmenting_bar", {"--compare", "--transport", "plain"}, {"transport", "--compare"}},
        {"fragmenting_bar",
         {"--formulation", "material_vectors", "--kernel", "w5"},
         {"kernel", "material_vectors"}},
    };
    check_refused(all);
}

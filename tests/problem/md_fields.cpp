// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of molecules as a user has them: momentum is balanced by bonds along their lines and missed by halves of
// them, the temperature is as much too low as few molecules make it.
#include "problem/found.hpp"
#include "problem/refused.hpp"

using namespace spam::test;

BOOST_AUTO_TEST_CASE(momentum_is_balanced_where_bonds_are_along_their_lines) {
    for (const Words& system :
         {Words{"--system", "fluid", "--cells", "16", "--t-end", "1", "--kernel", "w4",
                "--output-every", "0.5"},
          Words{"--system", "impact", "--radius", "7", "--t-end", "1.5", "--kernel", "w4"}}) {
        const Results found("md_fields", system, "balance_error");
        BOOST_TEST(found.claims == 1U);
        BOOST_TEST(found.value.at("balance_error") < 1e-8);
        BOOST_TEST(found.value.at("halves_error") > 0.03);
        BOOST_TEST(found.value.at("halves_error") < 0.25);
    }
}

// Three ranges, each of which would miss the expectation of the next.
BOOST_AUTO_TEST_CASE(few_molecules_have_too_low_a_temperature) {
    const Results found("md_fields", {"--system", "fluid", "--cells", "20", "--t-end", "4"},
                        "mean_temperature_3");
    BOOST_TEST(found.claims == 1U);
    double before = 0.0;
    for (const auto& [range, expected] : {std::pair{"3", 0.9072}, {"4", 0.9479}, {"6", 0.9768}}) {
        const double error = found.value.at("mean_temperature_" + std::string(range) + "_error"),
                     value = found.value.at("mean_temperature_" + std::string(range));
        BOOST_TEST(std::abs(value - expected) < 4.0 * error + 1e-3);
        BOOST_TEST(value > before + 4.0 * error);
        before = value;
    }
}

BOOST_AUTO_TEST_CASE(what_has_no_meaning_is_refused) {
    check_refused(std::vector<RefusedCall>{
        {"md_fields", {"--system", "impact", "--cells", "20"}, {"cells", "no box"}},
        {"md_fields", {"--system", "fluid", "--speed", "2"}, {"speed", "no crystals"}},
        {"md_fields", {"--radius", "4", "--offset", "9"}, {"offset: 9", "never meet"}},
        {"md_fields", {"--cells", "12"}, {"cells", "between 13 and"}},
    });
}

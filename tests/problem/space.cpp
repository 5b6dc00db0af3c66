// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that rotate in space: balanced torques keep the vector L, and a block tumbles as Jacobi says. A cloud of gas
// that flies apart, and one that fills a box. A bar that is torn. Under sanitizers, where what is measured takes
// minutes, smoke runs go the same ways.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>

using namespace spam::test;

BOOST_AUTO_TEST_CASE(balanced_torques_keep_the_vector_of_a_cube) {
    Words words{"--angular-momentum", "torque_pair", "--dt", "0.25"};
    if (!long_runs()) words.insert(words.end(), {"--turns", "0.5"});
    const Results found("rotating_body", words, "angular_momentum_change");
    BOOST_TEST(found.claims == (long_runs() ? 1U : 0U));
    BOOST_TEST(found.value.at("angular_momentum_change") < 1e-8);
    BOOST_TEST(found.value.at("newton_sums_by_rate") <= 5.0);
}

BOOST_AUTO_TEST_CASE(without_them_most_of_it_is_lost) {
    if (SPAM_SANITIZED) return;
    const Results found("rotating_body", {"--turns", "0.34"},
                        "angular_momentum_ratio_at_0.331_turns");
    BOOST_TEST(std::abs(found.value.at("angular_momentum_ratio_at_0.331_turns") - 0.366) < 0.01);
}

/// Smooth in space, unlike in the plane: the order of RK4 is there, and more.
BOOST_AUTO_TEST_CASE(torques_of_particles_keep_the_order_of_the_method) {
    if (SPAM_SANITIZED) return;
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
    if (SPAM_SANITIZED) return;
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
    if (SPAM_SANITIZED) return;
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
    if (SPAM_SANITIZED) return;
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
    if (long_runs()) {
        const Results found(
            "stability",
            {"--dimension", "3", "--lattice", "bcc", "--transport", "monaghan", "--stress", "0.01"},
            "monaghan_0.01_growth_rate");
        BOOST_TEST(found.claims == 1U);
        BOOST_TEST(!found.value.contains("plain_0.01_growth_rate"));
    }
    const Results one(
        "stability",
        {"--dimension", "3", "--transport", "plain", "--stress", "0.01", "--range", "2"},
        "plain_0.01_growth_rate");
    BOOST_TEST(one.claims == 1U);
}

namespace {

/// One lattice of three; the others in long runs.
bool in_the_suite(const std::string& lattice) {
    return long_runs() || (!SPAM_SANITIZED && lattice == "bcc");
}

/// A run stopped by a limit of steps and gone on with leaves the rows of one that was left alone.
void check_goes_on(const std::string& name, const Words& arguments) {
    const Scratch folder;
    const auto ran = [&](Words words) {
        words.insert(words.end(), {"--no-plots", "--quiet"});
        return Child(problem(name, words), {folder.path()}).finish(Child::Seconds(240)).status;
    };
    const auto to = [&](Words more) {
        more.insert(more.end(), arguments.begin(), arguments.end());
        return more;
    };
    BOOST_TEST(ran(to({"--out", "whole"})) == 0);
    BOOST_TEST(ran(to({"--out", "stopped", "--max-steps", "60"})) == 3);
    BOOST_TEST(ran({"--restart", "stopped", "--max-steps", "1000000"}) == 0);
    BOOST_TEST(contents_of(folder / "stopped/invariants.csv") ==
               contents_of(folder / "whole/invariants.csv"));
}

}  // namespace

/// One particle that was kicked: as long as the motion is linear K(t) is the sum over the waves of the sample, which
/// must be the right ones, one a particle, and then grows as the fastest. That one is an infinite lattice's too.
BOOST_AUTO_TEST_CASE(tensile_instability_in_space_grows_as_its_fastest_wave) {
    for (const auto& [lattice, cells, rate] :
         {std::tuple{"bcc", "4", 0.2004}, {"sc", "6", 0.3492}, {"fcc", "4", 0.1953}}) {
        if (!in_the_suite(lattice)) continue;
        const Results found("tensile_instability",
                            {"--dimension", "3", "--lattice", lattice, "--cells", cells, "--stress",
                             "0.02", "--range", "2"},
                            "kinetic_growth_rate");
        BOOST_TEST(found.claims == 1U);
        BOOST_TEST(found.value.at("kinetic_error_against_all_modes") < 2e-3);
        BOOST_TEST(std::abs(found.value.at("kinetic_growth_rate_predicted") / (2.0 * rate) - 1.0) <
                   5e-4);
        BOOST_TEST(std::abs(found.value.at("kinetic_growth_rate") / (2.0 * rate) - 1.0) < 0.01);
        BOOST_TEST(found.value.at("window_end") - found.value.at("window_begin") > 30.0);
    }
    const Results still("tensile_instability",
                        {"--smoke", "--dimension", "3", "--stress", "0", "--cells", "6"},
                        "kinetic_growth_rate");
    BOOST_TEST(still.claims == 0U);
    BOOST_TEST(still.value.at("largest_kinetic_ratio") <= 1.0);
    check_goes_on("tensile_instability", {"--smoke", "--dimension", "3", "--lattice", "bcc",
                                          "--stress", "0.02", "--checkpoint-every", "1.3"});
}

/// Sums over neighbours are the same for both waves, and so is what they do to the period: moduli are eta and 3 eta.
BOOST_AUTO_TEST_CASE(plane_wave_in_space_keeps_the_period_of_its_lattice) {
    for (const auto& [lattice, range] : {std::pair{"bcc", "2.6"}, {"sc", "3"}, {"fcc", "2"}}) {
        if (!in_the_suite(lattice)) continue;
        const Results found(
            "plane_wave",
            {"--dimension", "3", "--lattice", lattice, "--range", range, "--cells", "8"}, "period");
        BOOST_TEST(found.claims == 1U);
        for (const std::string prefix : {"", "longitudinal_"})
            BOOST_TEST(std::abs(found.value.at(prefix + "period_shift")) < 1e-4);
        BOOST_TEST(
            found.value.at("period") / found.value.at("longitudinal_period") == std::sqrt(3.0),
            boost::test_tools::tolerance(1e-4));
        BOOST_TEST(found.value.at("period_error") > 0.03);  // not that of elasticity
    }
    check_goes_on("plane_wave", {"--smoke", "--dimension", "3", "--polarization", "transverse",
                                 "--checkpoint-every", "3.3"});
    const Scratch folder;
    const auto refused = run_in(folder, "plane_wave", {"--dimension", "3", "--block", "3"});
    BOOST_TEST(refused.status == 2);
    BOOST_TEST(refused.err.find("--dimension 3, where no turning") != std::string::npos);
}

/// Another program's entropy of 12 x 12 x 12 particles, and none of streaming before they meet the box.
BOOST_AUTO_TEST_CASE(a_gas_in_space_gains_the_entropy_it_should) {
    if (SPAM_SANITIZED) return;
    const Results found("free_expansion", {"--dimension", "3", "--cells", "12"},
                        "entropy_sum_plateau");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(std::abs(found.value.at("entropy_sum_at_12") - 0.764) < 0.01);
    BOOST_TEST(found.value.at("energy_drift_per_particle") < 1e-6);
    const Results early("free_expansion", {"--dimension", "3", "--cells", "13", "--t-end", "4"},
                        "entropy_sum");
    BOOST_TEST(std::abs(early.value.at("entropy_sum")) < 0.05);
    BOOST_TEST(early.value.at("entropy_full_v2") > 0.2);
}

/// What a user may ask of it: mirrors, ranges of their own, three sizes, the cost.
BOOST_AUTO_TEST_CASE(a_gas_in_space_takes_the_options_of_the_plane) {
    for (const Words& more : {Words{"--walls", "mirror", "--front", "no-slip", "--t-end", "4"},
                              Words{"--ranges", "density", "--t-end", "4"},
                              Words{"--particles", "729", "--t-end", "2"}}) {
        Words words{"--smoke", "--dimension", "3"};
        words.insert(words.end(), more.begin(), more.end());
        const Results found("free_expansion", words, "entropy_sum");
        BOOST_TEST(std::isfinite(found.value.at("entropy_grid")));
    }
    const Results cost("free_expansion", {"--smoke", "--dimension", "3", "--cost"},
                       "n10_pairs_per_particle");
    BOOST_TEST(cost.value.at("n16_pairs_per_particle") > cost.value.at("n10_pairs_per_particle"));
    const Results three("free_expansion",
                        {"--smoke", "--dimension", "3", "--compare", "--t-end", "2"},
                        "n8_entropy_sum");
    BOOST_TEST(three.value.contains("n16_entropy_sum"));
}

/// Molecules part at what the bonds of a section bear, 65 (1 - 1/rows)/columns, and a little later.
BOOST_AUTO_TEST_CASE(a_bar_in_space_parts_where_its_bonds_tear) {
    if (long_runs()) {  // the smaller one below is of the same kind
        const Results molecules("tension_test", {"--dimension", "3", "--model", "pair_md"},
                                "load_at_parting");
        BOOST_TEST(molecules.claims == 1U);
        BOOST_TEST(molecules.value.at("load_at_parting") > 1.894);
        BOOST_TEST(molecules.value.at("second_piece") > 440.0);
    }
    const Results other(
        "tension_test",
        {"--smoke", "--dimension", "3", "--model", "pair_md", "--columns", "20", "--rows", "6"},
        "load_at_parting");
    BOOST_TEST(other.claims == 0U);
    BOOST_TEST(std::abs(other.value.at("load_at_parting") / (65.0 * (1.0 - 1.0 / 6.0) / 20.0) -
                        1.05) < 0.05);
    const Results smooth("tension_test", {"--smoke", "--dimension", "3"}, "load_at_parting");
    BOOST_TEST(smooth.value.at("pieces") >= 2.0);
}

BOOST_AUTO_TEST_CASE(elements_are_refused_in_space) {
    check_refused("tension_test", {{{"--dimension", "3", "--model", "elements"},
                                    {"dimension", "--model elements", "plane"}}});
}

/// Pieces keep their angular momentum from when they have parted.
BOOST_AUTO_TEST_CASE(a_ball_in_space_breaks_a_plate) {
    const char* const kept = "angular_momentum_change_of_pieces";
    const Words small{"--dimension", "3", "--model", "pair_md", "--radius", "3", "--columns", "12"};
    const auto hit = [&](const char* speed, const char* seed) {
        Words words = small;
        words.insert(words.end(), {"--rows", "4", "--speed", speed, "--seed", seed});
        const Results found("ball_plate", words, kept);
        BOOST_TEST(found.claims == 1U);
        return found.value;
    };
    auto slow = hit("1", "1"), fast = hit("8", "1"), other = hit("8", "2");
    BOOST_TEST(slow["pieces"] == 1.0);
    BOOST_TEST(fast["pieces"] > 40.0);
    BOOST_TEST(fast[kept] > 0.0);
    BOOST_TEST(fast["ball_speed"] != other["ball_speed"]);
    check_goes_on("ball_plate", {"--smoke", "--dimension", "3", "--model", "pair_md", "--speed",
                                 "8", "--checkpoint-every", "0.13"});
    check_refused("ball_plate",
                  {{{"--dimension", "3", "--model", "elements"}, {"dimension", "elements"}},
                   {{"--dimension", "3", "--model", "embedded_atom"}, {"dimension", "at rest"}}});
}

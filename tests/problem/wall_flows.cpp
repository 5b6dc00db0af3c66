// SPDX-License-Identifier: GPL-3.0-or-later
// Problems with walls as a user runs them: what each wall gives is what physics says, accounts close with the
// order of the integrator, and sides are options.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam::test;

namespace {

const Words mirrors{"--left",   "mirror", "--right", "mirror",
                    "--bottom", "mirror", "--top",   "mirror"};

Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Largest drift of the energy, or of the momentum, less what walls and externals gave.
double drift_of(const Results& found, const std::string& what) {
    double largest = -1.0;
    for (const auto& [name, value] : found.value)
        if (name.ends_with(what + "_drift") && !name.ends_with("angular_" + what + "_drift"))
            largest = std::max(largest, value);
    return largest;
}

}  // namespace

// Before anything has arrived the ends feel the pressures of the gases at rest.
BOOST_AUTO_TEST_CASE(ends_of_a_shock_tube_feel_the_pressure) {
    const Results found("shock_tube", {"--single"}, "pressure_on_left");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(std::abs(found.value.at("pressure_on_left") - 1.0) < 1e-3);
    BOOST_TEST(std::abs(found.value.at("pressure_on_right") - 0.1) < 1e-4);
}

// At planes of symmetry mirrors change nothing: the same decay, the same errors.
BOOST_AUTO_TEST_CASE(vortices_between_mirrors_are_as_exact) {
    const Results found("taylor_green",
                        joined(mirrors, long_runs() ? Words{} : Words{"--cells", "24"}),
                        "shifting_velocity_error");
    BOOST_TEST(std::abs(found.value.at("shifting_decay_rate") / 0.789568 - 1.0) < 0.03);
    BOOST_TEST(found.value.at("shifting_velocity_error") < 0.05);
    // No-slip walls there: another flow, of which nothing is known.
    const Results other("taylor_green", {"--smoke", "--left", "no-slip", "--right", "no-slip"},
                        "shifting_energy_drift");
    BOOST_TEST(other.value.count("shifting_velocity_error") == 0U);
}

// 1e-6 with the steps that problems choose, and with half of them an eighth at most (a sixteenth is the order).
BOOST_AUTO_TEST_CASE(accounts_close_with_the_order_of_the_integrator) {
    struct One {
        std::string problem;
        double dt;
        Words arguments;
        double energy = 1e-6;
    };
    const std::vector<One> all{
        {"couette", 0.25, {"--t-end", "50"}},
        {"couette", 0.25, {"--t-end", "25", "--left", "mirror", "--right", "no-slip"}},
        {"poiseuille", 0.25, {"--t-end", "50"}},
        {"taylor_green", 0.2, joined(mirrors, {"--t-end", "25", "--cells", "24"})},
        {"cavity", 0.2, {"--t-end", "25", "--cells", "20"}},
        {"free_expansion", 0.25, {"--cells", "24", "--walls", "mirror"}},
        {"free_expansion",
         0.25,
         {"--cells", "24", "--left", "rigid", "--right", "rigid", "--bottom", "rigid", "--top",
          "rigid"}},
        {"shock_tube", 0.0005, {"--cells", "200", "--single", "--t-end", "0.3"}},
        {"rayleigh_benard", 0.2, {"--height", "10", "--t-end", "100"}},
        // Cores that meet are stiff: 2e-6 of the default column.
        {"water_column", 0.05, {"--width", "8", "--relaxation-time", "20"}, 4e-6}};
    for (const One& one : all) BOOST_TEST_CONTEXT(one.problem << one.arguments.back()) {
            const auto with = [&](double dt) {
                return joined(one.arguments, {"--dt", std::to_string(dt)});
            };
            const Results coarser(one.problem, with(one.dt), "");
            const double coarse = drift_of(coarser, "energy"),
                         fine = drift_of(Results(one.problem, with(0.5 * one.dt), ""), "energy");
            BOOST_TEST(coarse >= 0.0);
            BOOST_TEST(coarse < one.energy);
            BOOST_TEST((fine < coarse / 8.0 || fine < 1e-13));
            const double momentum = drift_of(coarser, "momentum");
            BOOST_TEST(momentum >= 0.0);
            BOOST_TEST(momentum < 1e-12);
        }
}

// Sides of problems: they run, with accounts that close, or are refused with the reason.
BOOST_AUTO_TEST_CASE(sides_are_options_of_problems_with_walls) {
    const std::vector<std::pair<std::string, Words>> runs{
        {"couette", {"--left", "mirror", "--right", "rigid"}},
        {"couette", {"--top", "moving:-0.05"}},
        {"poiseuille", {"--bottom", "mirror", "--top", "mirror"}},
        {"cavity", {"--left", "mirror", "--right", "mirror"}},
        {"cavity", {"--left", "periodic", "--right", "periodic", "--bottom", "moving:-0.1"}},
        {"taylor_green", {"--bottom", "mirror", "--top", "mirror"}},
        {"shock_tube", {"--left", "no-slip", "--right", "open"}},
        {"shock_tube", {"--left", "rigid", "--right", "rigid"}},
        {"free_expansion", {"--left", "mirror", "--right", "rigid"}},
        {"free_expansion",
         {"--dimension", "1", "--cells", "64", "--left", "mirror", "--right", "rigid"}},
        {"free_expansion", {"--walls", "mirror", "--top", "open"}},
        {"rayleigh_benard", {"--left", "mirror", "--right", "no-slip"}},
        {"water_column", {"--left", "rigid", "--right", "rigid"}}};
    for (const auto& [problem, words] : runs) BOOST_TEST_CONTEXT(problem << " " << words.back()) {
            BOOST_TEST(drift_of(Results(problem, joined(words, {"--smoke"}), ""), "energy") < 1e-5);
        }
    check_refused(std::vector<RefusedCall>{
        {"couette",
         {"--left", "mirror"},
         {"right: 'periodic' but --left is not; make both of them periodic, or neither"}},
        {"couette", {"--top", "moving:fast"}, {"give a number"}},
        {"couette", {"--top", "no-slip@1"}, {"nothing here conducts heat", "leave '@1' out"}},
        {"poiseuille", {"--top", "rigid@2"}, {"nothing behind it"}},
        {"cavity", {"--top", "open"}, {"shifting drives particles out"}},
        {"cavity", {"--left", "rigid"}, {"go on through it"}},
        {"cavity",
         {"--cells", "8", "--range", "6", "--left", "mirror", "--transport", "plain", "--bottom",
          "wall"},
         {"bottom: 'wall' is none of open, periodic, mirror, no-slip, moving:V, rigid or moving"}},
        {"shock_tube", {"--left", "periodic", "--right", "periodic"}, {"without a diaphragm"}},
        {"shock_tube", {"--left", "moving:1"}, {"on a line there is no such motion"}},
        {"shock_tube", {"--left", "mirror@2"}, {"nothing here conducts heat"}},
        {"rayleigh_benard", {"--top", "no-slip@-1"}, {"'-1' for a temperature", "between 1e-06"}},
        {"rayleigh_benard",
         {"--top", "rigid"},
         {"heat must come from below", "use mirror, no-slip"}},
        {"rayleigh_benard", {"--left", "open"}, {"would let the gas out", "use periodic, mirror"}},
        {"water_column", {"--bottom", "no-slip"}, {"feel nothing of", "use mirror or rigid"}},
        {"water_column", {"--left", "open"}, {"before it has come to rest"}},
        {"free_expansion", {"--left", "mirror"}, {"--left is not"}},
        {"free_expansion",
         {"--dimension", "1", "--top", "mirror"},
         {"a line has a left and a right end"}},
    });
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Theories of beams, and the oscillating plate as a user runs it.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <cantilever/beam.hpp>

#include <cmath>
#include <numbers>

using namespace spam::test;
using namespace cantilever;

namespace {

bool near(double value, double expected, double part) {
    return std::abs(value / expected - 1.0) < part;
}

Words quick(int layers, const Words& more = {}) {
    Words all{"--layers", std::to_string(layers),         "--integrator", "leapfrog",
              "--dt",     std::to_string(1.5e-4 / layers)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(beams) {
    Beam beam;
    BOOST_TEST(near(beam.thin_period(), 0.2540, 5e-4));
    BOOST_TEST(near(beam.period(), 0.2565, 1e-3));
    // Rotary inertia and shear are matters of thickness squared.
    Beam thinner = beam;
    thinner.thickness = 0.1 * beam.thickness;
    const auto excess = [](const Beam& b) { return b.period() / b.thin_period() - 1.0; };
    BOOST_TEST(near(excess(beam) / excess(thinner), 100.0, 0.05));
    BOOST_TEST(near(thinner.thin_period(), 10.0 * beam.thin_period(), 1e-12));
    BOOST_TEST(beam.shape(-0.01) == 0.0);
    BOOST_TEST(near(beam.shape(0.2), 1.0, 1e-12));
    BOOST_TEST(near(beam.shape(0.1), 0.3395, 1e-3));  // of tables of the first mode
    beam.thickness = 5.0 * beam.length;
    BOOST_CHECK_THROW(beam.period(), std::domain_error);
}

/// omega L^2 sqrt(rho A/(E I)) of a bar 10 sqrt(4/3) times as long as thick, lambda = eta: the equations of the
/// beam integrated from end to end by another program. With r and s exchanged 21.27 comes out.
BOOST_AUTO_TEST_CASE(free_beams) {
    Beam beam{10.0, std::sqrt(0.75), 2.5, 0.25, 1.2};
    const auto b = [](const Beam& one) {
        return 2.0 * std::numbers::pi / one.free_period() * one.length * one.length /
               (one.thickness * std::sqrt(one.modulus() / (12.0 * one.density)));
    };
    BOOST_TEST(near(b(beam), 21.783953, 1e-6));
    beam.thickness *= 1e-3;
    BOOST_TEST(near(b(beam), 22.373285, 1e-6));  // of a thin one
    BOOST_TEST(near(beam.free_shape(5.0), 1.0, 1e-12));
    BOOST_TEST(near(beam.free_shape(-5.0), 1.0, 1e-12));
    BOOST_TEST(std::abs(beam.free_slope(0.0)) < 1e-12);
    BOOST_TEST(std::abs(beam.free_shape(0.2242 * 10.0 - 5.0)) < 1e-3);  // a node, of tables
    BOOST_TEST(near(beam.free_slope(2.0), (beam.free_shape(2.001) - beam.free_shape(1.999)) / 0.002,
                    1e-6));
    beam.thickness = 5.0 * beam.length;
    BOOST_CHECK_THROW(beam.free_period(), std::domain_error);
}

// The lowest eigenvalues of the linearised equations, found by another program.
BOOST_AUTO_TEST_CASE(layers_of_particles_bend_more_easily) {
    const Beam beam;
    for (const auto& [range, layers, period] : {std::tuple{1.5, 10, 0.26097},
                                                {1.5, 20, 0.25773},
                                                {2.0, 5, 0.29734},
                                                {2.0, 10, 0.26744},
                                                {2.0, 20, 0.25931},
                                                {2.0, 40, 0.25678},
                                                {2.6, 10, 0.27250},
                                                {2.6, 20, 0.26085},
                                                {3.0, 20, 0.26215}})
        BOOST_TEST(near(layered_period(beam, layers, range), period, 0.005));
    BOOST_TEST(near(layered_period(beam, 1000, 2.0), beam.period(), 2e-4));
    BOOST_TEST(near(limit_of_doubling(2.0 + 3.0 / 5 + 7.0 / 25, 2.0 + 3.0 / 10 + 7.0 / 100,
                                      2.0 + 3.0 / 20 + 7.0 / 400),
                    2.0, 1e-12));
}

BOOST_AUTO_TEST_CASE(ten_layers) {
    if (!long_runs()) return;  // twice as many as below
    const Results found("cantilever", quick(10), "period");
    BOOST_TEST(found.claims == 1U);
    BOOST_TEST(near(found.value.at("period"), 0.267, 0.002));  // SPHinXsys: 0.2747
    BOOST_TEST(near(found.value.at("largest_tip"), 0.110, 0.01));
    BOOST_TEST(found.value.at("energy_drift") < 1e-4);
}

BOOST_AUTO_TEST_CASE(small_oscillations_are_linear) {
    const Results found("cantilever", quick(5, {"--speed", "0.001"}), "period");
    BOOST_TEST(near(found.value.at("period"), 0.29734, 5e-4));  // the eigenvalue above
}

BOOST_AUTO_TEST_CASE(other_plates) {
    // With Young's modulus four times as large in half the time; with gravity about another place.
    const Results stiff("cantilever",
                        {"--layers", "5", "--young", "8e6", "--integrator", "leapfrog", "--dt",
                         "1.5e-5", "--speed", "0.001"},
                        "period");
    BOOST_TEST(near(stiff.value.at("period"), 0.5 * 0.29734, 1e-3));
    for (const char* const ratio : {"--poisson=-0.9", "--poisson=-0.5"}) {
        const Results widens("cantilever", {"--smoke", ratio}, "energy_drift");
        BOOST_TEST(widens.value.at("energy_drift") < 5e-5);
    }
    if (!long_runs()) return;  // the same law once more
    const Results heavy("cantilever", quick(5, {"--gravity", "2", "--speed", "0.001"}), "period");
    BOOST_TEST(near(heavy.value.at("period"), 0.297, 0.01));
    const Results updated("cantilever", {"--layers", "5", "--formulation", "updated"}, "period");
    BOOST_TEST(updated.value.at("period") > 0.3);
    BOOST_TEST(updated.claims == 0U);
}

BOOST_AUTO_TEST_CASE(plates_without_meaning_are_refused) {
    const std::vector<Refused> all{
        {{"--length", "0.05"}, {"length: 0.05", "0.02", "no plate"}},
        {{"--thickness", "1e-5"}, {"length: 0.2", "thousand"}},
        {{"--layers", "2"}, {"layers", "between 3 and 200"}},
        {{"--layers", "5", "--compare"}, {"layers: --compare", "6 or more"}},
        {{"--poisson", "0.5"}, {"poisson", "0.499"}},
        {{"--viscosity", "-1"}, {"viscosity", "between"}},
        {{"--penalty", "1", "--formulation", "updated"}, {"penalty", "updated"}},
    };
    check_refused("cantilever", all);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The column of water as a mesh of finite elements, as a user runs it: at rest, on its way, beside particles.
#include "problem/found.hpp"
#include "problem/refused.hpp"
#include "support/effort.hpp"

#include <cmath>

using namespace spam::test;

namespace {

Words elements(const char* width, const char* mesh, const Words& more) {
    Words words{"--model", "elements", "--width", width,          "--aspect",
                "1.6",     "--mesh",   mesh,      "--cavitation", "0.02"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

}  // namespace

BOOST_AUTO_TEST_CASE(rows_at_rest_carry_what_lies_above_them) {
    double before = 0.0;
    for (const char* mesh : {"2x8", "2x16", "2x32", "2x64"}) {
        const Results found("water_column", elements("40", mesh, {"--t-end", "1"}),
                            "profile_error");
        BOOST_TEST(found.value.at("pressure_error") < 1e-6);
        const double error = found.value.at("profile_error");
        if (before > 0.0) BOOST_TEST(std::abs(std::log2(before / error) - 2.0) < 0.15);
        before = error;
    }
    BOOST_TEST(std::abs(before / 4.78e-6 - 1.0) < 0.02);  // of 64 rows, by a separate sum
}

BOOST_AUTO_TEST_CASE(half_the_size_falls_in_half_the_time) {
    const Words briefly{"--relaxation-time", "40", "--t-end", "30"},
        half{"--relaxation-time", "20", "--t-end", "15"};
    const Results whole("water_column", elements("40", "16x16", briefly), "front_at_30"),
        other("water_column", elements("20", "16x16", half), "front_at_15");
    for (const std::string name : {"front", "centre_height", "leading_percent", "height"}) {
        const double length = whole.value.at(name + "_at_30");
        BOOST_TEST(std::abs(2.0 * other.value.at(name + "_at_15") - length) < 1e-10 * length);
    }
    BOOST_TEST(whole.value.at("front_at_30") > 45.0);
    BOOST_TEST(whole.value.at("hourglass_work") > 0.0);
    BOOST_TEST(whole.claims == 0U);  // another mesh, another rest
}

BOOST_AUTO_TEST_CASE(particles_and_elements_fall_alike) {
    const Results found("water_column",
                        {"--model", "both", "--width", "12", "--cavitation", "0.02",
                         "--relaxation-time", "60", "--t-end", "12", "--samples", "2"},
                        "centre_height_difference_at_12");
    BOOST_TEST(std::abs(found.value.at("centre_height_difference_at_12")) < 0.3);
    BOOST_TEST(std::abs(found.value.at("kinetic_difference_at_12")) < 0.1);
    BOOST_TEST(found.value.at("centre_height_deviation_at_12") >= 0.0);
    BOOST_TEST(found.value.count("front_difference_at_9") == 1U);
}

BOOST_AUTO_TEST_CASE(the_mesh_of_the_lecture) {
    if (!long_runs()) return;
    const Results found("water_column",
                        elements("40", "80x64", {"--dt", "0.1", "--t-end", "40", "--threads", "1"}),
                        "centre_height_at_40");
    BOOST_TEST(found.claims == 1U);
}

// What y does not hold is in snapshots all the same: the player and ParaView colour elements by pressure.
BOOST_AUTO_TEST_CASE(snapshots_have_what_follows_from_the_corners) {
    const Scratch folder;
    const Outcome outcome = run_in(
        folder, "water_column", elements("8", "6x9", {"--relaxation-time", "3", "--t-end", "4"}));
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    const auto listed = collection(folder / "out/collapse/snapshots.pvd");
    const Vtp vtp(folder / ("out/collapse/" + listed.back().second));
    BOOST_TEST(vtp.polygons == 54U);
    BOOST_TEST(vtp.vertices == 0U);
    const auto &rho = vtp.arrays.at("element_density"), &stress = vtp.arrays.at("element_stress"),
               &energy = vtp.arrays.at("element_energy"),
               &work = vtp.arrays.at("element_hourglass_work"), &x = vtp.arrays.at("Points"),
               &mass = vtp.arrays.at("mass");
    double internal = 0.0;
    bool torn = false;
    for (std::size_t k = 0; k < 54; ++k) {
        const double P = rho[k] * rho[k] * (rho[k] - 1.0);
        torn = torn || P < -0.02;
        BOOST_TEST(std::abs(stress[9 * k] + std::max(P, -0.02)) < 1e-14);
        BOOST_TEST(stress[9 * k] == stress[9 * k + 4]);
        BOOST_TEST(stress[9 * k + 1] == 0.0);
        BOOST_TEST(energy[k] >= work[k]);
        internal += 8.0 * 13.0 / 54.0 * energy[k];
    }
    BOOST_TEST(work[20] > 0.0);
    for (std::size_t i = 0; i < mass.size(); ++i) internal += 0.4 / 13.0 * mass[i] * x[3 * i + 1];
    const Csv rows(folder / "out/collapse/invariants.csv");
    BOOST_TEST(std::abs(internal / rows.column("internal").back() - 1.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(meshes_without_meaning_are_refused) {
    const std::vector<Refused> all{
        {{"--mesh", "80x64"}, {"mesh", "--model particles", "give --model elements"}},
        {{"--hourglass-viscosity", "0.2"}, {"hourglass-viscosity", "--model particles"}},
        {{"--model", "elements", "--mesh", "80"}, {"mesh: '80'", "80x64"}},
        {{"--model", "elements", "--mesh", "0x5"}, {"mesh: '0x5'", "1 to 1000"}},
        {{"--model", "elements", "--mesh", "8x5x3"}, {"mesh: '8x5x3'"}},
        {{"--model", "elements", "--compare"}, {"compare", "one column"}},
        {{"--model", "both", "--compare"}, {"compare", "one column"}},
        {{"--model", "elements", "--samples", "3"}, {"samples", "one column"}},
        {{"--model", "elements", "--range", "3"}, {"range", "no weight function"}},
        {{"--model", "elements", "--kernel", "w4"}, {"kernel", "no weight function"}},
        {{"--model", "elements", "--core", "1"}, {"core", "no fields of particles"}},
        {{"--model", "elements", "--surface-tension", "0.1"},
         {"surface-tension", "fields of particles"}},
        {{"--model", "elements", "--left", "rigid"}, {"left", "guided"}},
        {{"--model", "elements", "--bottom", "mirror"}, {"bottom", "guided"}},
        {{"--model", "solid"}, {"model", "particles", "elements", "both"}},
    };
    check_refused("water_column", all);
}

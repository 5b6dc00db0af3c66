// SPDX-License-Identifier: GPL-3.0-or-later
// Problems whose lengths, masses and moduli are options, in other units: the same rows, to the bit where the units
// are powers of two, with fixed steps and adaptive ones.
#include "problem/result_files.hpp"
#include <spam/core/dimensions.hpp>

#include <boost/test/unit_test.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

using namespace spam;
using namespace spam::test;

namespace {

/// An option whose value has this unit in space.
struct Quantity {
    const char* option;
    double value;
    const char* unit;
};

/// A problem as it is called; `dimensions`: of the run, whose rows are of a unit of length across where that is 2.
struct Case {
    const char* problem;
    int dimensions;
    std::vector<std::string> words;
    std::vector<Quantity> quantities;
};

const std::vector<std::string> adaptive{"--integrator", "arkode:DORMAND_PRINCE_7_4_5", "--rtol",
                                        "1e-6"};
const std::map<std::string, const char*> units_of_columns{{"t", "t"},
                                                          {"dt", "t"},
                                                          {"mass", "m"},
                                                          {"momentum", "m l/t"},
                                                          {"angular_momentum", "m l^2/t"},
                                                          {"kinetic", "m l^2/t^2"},
                                                          {"internal", "m l^2/t^2"},
                                                          {"energy", "m l^2/t^2"},
                                                          {"work", "m l^2/t^2"},
                                                          {"heat", "m l^2/t^2"},
                                                          {"impulse", "m l/t"},
                                                          {"angular_impulse", "m l^2/t"},
                                                          {"tip", "l"},
                                                          {"length", "l"},
                                                          {"foot", "l"},
                                                          {"largest_plastic_strain", "1"}};

/// What a run leaves.
struct Left {
    Csv rows;
    nlohmann::json statistics;
};

Left run(const Case& one, const Units& u) {
    const Scratch folder;
    std::vector<std::string> words{"--out", "out", "--no-plots", "--quiet"};
    words.insert(words.end(), one.words.begin(), one.words.end());
    for (const Quantity& q : one.quantities)
        words.insert(words.end(), {fmt::format("--{}", q.option),
                                   fmt::format("{:.17g}", q.value * u.of(q.unit, 3))});
    const Outcome outcome =
        Child(problem(one.problem, words), {folder.path()}).finish(Child::Seconds(120));
    // A smoke run is too short for some of the problem's own checks.
    BOOST_REQUIRE_MESSAGE(outcome.status == 0 || outcome.status == 1, outcome.out << outcome.err);
    return {Csv(folder / "out/invariants.csv"), json_of(folder / "out/statistics.json")};
}

/// The unit of a column, "momentum_x" of a run in the plane, by the units of space.
double unit_of(std::string column, const Case& one, const Units& u) {
    if (column.ends_with("_x") || column.ends_with("_y") || column.ends_with("_z"))
        column.resize(column.size() - 2);
    BOOST_REQUIRE_MESSAGE(units_of_columns.contains(column), column << " has no unit here");
    Units rows = u;
    if (one.dimensions == 2) rows.mass /= u.length;
    return rows.of(units_of_columns.at(column), one.dimensions);
}

/// The largest difference of a number in parts of the largest of its column; of momenta, which may be nothing but
/// rounding, at least of a small part of what particles have.
double difference(const Case& one, const Left& here, const Left& there, const Units& u,
                  bool same_steps) {
    double worst = 0.0;
    BOOST_TEST_REQUIRE(here.rows.cells.size() == there.rows.cells.size());
    const auto largest = [&](const std::string& name) {
        double size = 0.0;
        for (const double x : here.rows.column(name)) size = std::max(size, std::abs(x));
        return size;
    };
    const double least_momentum = 1e-4 * std::sqrt(largest("mass") * largest("kinetic"));
    for (const auto& name : here.rows.names) {
        if (name == "dt" && !same_steps) continue;
        const double unit = unit_of(name, one, u);
        const auto a = here.rows.column(name), b = there.rows.column(name);
        double size = largest(name);
        if (name.find("angular") != name.npos)
            size = std::max(size, least_momentum * one.quantities.front().value);
        else if (name.find("mom") != name.npos || name.find("impulse") != name.npos)
            size = std::max(size, least_momentum);
        for (std::size_t k = 0; k < a.size(); ++k) {
            const double off = std::abs(b[k] / unit - a[k]);
            const double part = off == 0.0 ? 0.0 : off / size;
            if (!(part <= worst)) worst = part;
        }
    }
    return worst;
}

void check(Case one, bool fixed) {
    if (!fixed) one.words.insert(one.words.end(), adaptive.begin(), adaptive.end());
    const Units powers_of_two{4.0, 0.25, 0.5};  // even: roots are taken
    const Left here = run(one, {});
    BOOST_TEST(here.rows.cells.size() > 5u);
    for (const Units& u : {powers_of_two, Units{7.0, 3.0, 2.0}, Units{1e-3, 1e6, 1e6}})
        BOOST_TEST_CONTEXT(one.problem << " in units " << u.mass << ", " << u.length << ", "
                                       << u.time << (fixed ? ", fixed" : ", adaptive")) {
            const Left there = run(one, u);
            // Errors are differences: where some steps are rejected, rounding decides on others.
            const bool exact = u.mass == powers_of_two.mass;
            const bool same_steps = exact || fixed || here.statistics.at("rejected_steps") == 0;
            if (same_steps)
                for (const char* count : {"steps", "rejected_steps", "rhs_evaluations"})
                    BOOST_TEST(here.statistics.at(count) == there.statistics.at(count), count);
            const double off = difference(one, here, there, u, same_steps);
            BOOST_TEST(off <= (exact ? 0.0 : fixed ? 1e-9 : same_steps ? 1e-7 : 1e-4));
        }
}

Case plate(const char* formulation) {
    return {"cantilever",
            2,
            {"--layers", "3", "--formulation", formulation},
            {{"length", 0.25, "l"},
             {"thickness", 0.03125, "l"},
             {"young", 2e6, "m/l t^2"},
             {"density", 1000.0, "m/l^3"},
             {"gravity", 10.0, "l/t^2"},
             {"t-end", 0.03125, "t"}}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_oscillating_plate) {
    for (const char* formulation : {"total_lagrangian", "updated", "material_vectors"})
        for (const bool fixed : {true, false}) check(plate(formulation), fixed);
}

BOOST_AUTO_TEST_CASE(a_bar_against_a_wall) {
    for (const bool fixed : {true, false})
        check({"taylor_bar",
               3,
               {"--particles-per-radius", "2"},
               {{"radius", 3.2, "l"},
                {"speed", 227.0, "l/t"},
                {"young", 117.0, "m/l t^2"},
                {"yield-stress", 0.4, "m/l t^2"},
                {"hardening", 0.1, "m/l t^2"},
                {"density", 8930.0, "m/l^3"},
                {"t-end", 4.0, "t"}}},
              fixed);
}

BOOST_AUTO_TEST_CASE(an_option_in_another_unit_is_seen) {
    const Units u{4.0, 0.25, 2.0};
    Case wrong = plate("total_lagrangian");
    const Left here = run(wrong, {});
    wrong.quantities[4].unit = "1";
    BOOST_TEST(difference(wrong, here, run(wrong, u), u, true) > 1e-6);
}

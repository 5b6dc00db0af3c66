// SPDX-License-Identifier: GPL-3.0-or-later
// The studies of integrators as a user runs them: what their tables hold, what their options refuse, and
// that one which was killed goes on.
#include "problem/refused.hpp"
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>

#include <set>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

Outcome run_in(const Scratch& folder, const std::string& name, const Words& arguments) {
    return Child(problem(name, arguments), {folder.path()}).finish(Child::Seconds(600));
}

std::set<std::string> values(const Csv& table, const std::string& column) {
    const auto at = std::find(table.names.begin(), table.names.end(), column);
    std::set<std::string> all;
    for (const auto& row : table.cells)
        all.insert(row.at(static_cast<std::size_t>(at - table.names.begin())));
    return all;
}

}  // namespace

/// In the plane, and in space.
BOOST_AUTO_TEST_CASE(smoke_runs_of_accuracy_fill_their_tables) {
    for (const Words& chosen : {Words{}, Words{"--problem", "cube"}}) {
        const Scratch folder;
        Words arguments{"--smoke", "--no-plots", "--out", "out"};
        arguments.insert(arguments.end(), chosen.begin(), chosen.end());
        const Outcome outcome = run_in(folder, "integrator_accuracy", arguments);
        BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
        const Csv table(folder / "out/integrator_accuracy.csv");
        BOOST_TEST((values(table, "problem") ==
                    std::set<std::string>{chosen.empty() ? "md" : chosen.back()}));
        BOOST_TEST((values(table, "method") ==
                    std::set<std::string>{"rk4", "arkode:DORMAND_PRINCE_7_4_5"}));
        BOOST_TEST((values(table, "steps") == std::set<std::string>{"fixed", "adaptive"}));
        BOOST_TEST(values(table, "end").contains("measured"));
        BOOST_TEST(values(table, "floor").size() == 1u);
        const Csv orders(folder / "out/orders.csv");
        BOOST_TEST((values(orders, "nominal") == std::set<std::string>{"4", "5"}));
        for (const double order : orders.column("points")) BOOST_TEST(order == 4.0);
        const auto nominal = orders.column("nominal"), observed = orders.column("order");
        for (std::size_t k = 0; k < nominal.size(); ++k)
            BOOST_TEST(std::abs(observed[k] - nominal[k]) < 0.1);
    }
}

BOOST_AUTO_TEST_CASE(a_smoke_run_of_drifts_fills_its_table) {
    const Scratch folder;
    const Outcome outcome =
        run_in(folder, "invariant_drift", {"--smoke", "--no-plots", "--out", "out"});
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    const Csv table(folder / "out/invariant_drift.csv");
    BOOST_TEST(
        (values(table, "problem") ==
         std::set<std::string>{"hexagon", "material_vectors", "md", "total_lagrangian", "wave"}));
    for (const double drift : table.column("momentum_drift")) BOOST_TEST(drift < 1e-12);
    for (const double drift : table.column("energy_drift")) BOOST_TEST(drift < 1e-3);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out/drifts")) {
        BOOST_TEST(Csv(entry.path()).cells.size() > 50u);
        ++files;
    }
    BOOST_TEST(files == table.cells.size());
}

BOOST_AUTO_TEST_CASE(killed_it_goes_on) {
    const Words arguments{"--problem",  "md",     "--methods", "rk4",   "--calls", "20000",
                          "--no-plots", "--jobs", "1",         "--out", "out"};
    const Scratch folder;
    Child child(problem("integrator_accuracy", arguments), {folder.path()});
    const auto part = folder / "out/integrator_accuracy.part.csv";
    child.wait_for([&](const Outcome&) {
        if (!std::filesystem::exists(part)) return false;
        const std::string text = contents_of(part);
        return std::count(text.begin(), text.end(), '\n') > 4;
    });
    child.send(SIGKILL);
    BOOST_TEST(child.finish().signal == SIGKILL);
    const Outcome again = run_in(folder, "integrator_accuracy", arguments);
    BOOST_TEST(again.status == 0, again.out << again.err);
    BOOST_TEST(again.out.find("are known already") != std::string::npos);
    BOOST_TEST(Csv(folder / "out/integrator_accuracy.csv").cells.size() == 17u);
}

BOOST_AUTO_TEST_CASE(options_that_make_no_sense_are_refused) {
    const std::vector<RefusedCall> all{
        {"integrator_accuracy", {"--problem", "sun"}, {"problem", "sun"}},
        {"integrator_accuracy", {"--methods", "rk5"}, {"methods", "rk5"}},
        {"integrator_accuracy", {"--methods", "rk4,rk4"}, {"methods", "twice"}},
        {"integrator_accuracy", {"--calls", "3"}, {"calls", "3", "between 500 and"}},
        {"integrator_accuracy", {"--tightest", "1e-20"}, {"tightest", "1e-20"}},
        {"integrator_accuracy", {"--dt", "0.1"}, {"dt", "no meaning"}},
        {"integrator_accuracy",
         {"--problem", "hexagon", "--methods", "leapfrog"},
         {"methods", "hexagon", "leapfrog"}},
        {"invariant_drift", {"--calls-per-time", "0"}, {"calls-per-time", "0"}},
        {"invariant_drift", {"--turns", "-1"}, {"turns", "-1"}},
        {"invariant_drift", {"--integrator", "rk4"}, {"no meaning"}},
    };
    check_refused(all);
}

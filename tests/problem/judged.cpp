// SPDX-License-Identifier: GPL-3.0-or-later
// What every run is judged by, in a problem of one's own: its promises, whether the problem thinks of them
// or not, and that nothing that is no number passes for a result.
#include "problem/result_files.hpp"
#include <spam/material/harmonic_spring.hpp>
#include <spam/spam.hpp>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>

using namespace spam;
using spam::test::contents_of;
using spam::test::Csv;
using spam::test::json_of;
using spam::test::Scratch;

namespace {

/// Eight masses and springs on a line that something pulls along.
class PulledChain final : public Model<1> {
  public:
    explicit PulledChain(double force)
        : Model<1>(make_particles<1>(square_lattice<1>({8}), 1.0), {},
                   {Field::position, Field::velocity}),
          chain_(particles(), HarmonicSpring{}),
          force_(force) {}

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override {
        chain_.rates(t, y, y_dot);
        State<1>(layout(), y_dot).velocity().array() += force_;
    }
    double internal_energy(std::span<const double> y) const override {
        return chain_.internal_energy(y);
    }
    Promises promises() const override { return chain_.promises(); }
    std::string describe() const override { return "a chain that is pulled"; }
    std::size_t pairs() const override { return chain_.pairs(); }
    double reach() const override { return chain_.reach(); }

  private:
    BondedModel<1> chain_;
    double force_;
};

Case<1> chain_case(PulledChain& chain, const std::string& label = "") {
    auto y0 = initial_state<1>(chain, 1.0, 1.0,
                               [](const Point<1>& x) { return Point<1>(x[0] == 0.0 ? 0.1 : 0.0); });
    Plan<1> plan;
    plan.t_end = 2.0;
    plan.output_every = 1.0;
    return {kept_elsewhere<1>(chain), std::move(y0), std::move(plan), label};
}

int run(const Scratch& folder, const std::function<void(Session&)>& body) {
    Problem problem("my_chain", "a chain of springs");
    std::vector<std::string> words{
        "my_chain", "--quiet", "--no-plots", "--dt", "0.05", "--out", (folder / "out").string()};
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    return problem.main(static_cast<int>(arguments.size()), arguments.data(), body);
}

/// Names of what was checked, in order, with a ! before those that do not hold.
std::string checked(const Scratch& folder) {
    std::string names;
    for (const auto& item : json_of(folder / "out/result.json")) {
        if (!names.empty()) names += ' ';
        if (!item.at("holds").get<bool>()) names += '!';
        names += item.at("name").get<std::string>();
    }
    return names;
}

}  // namespace

BOOST_AUTO_TEST_CASE(promises_are_checked_though_the_problem_forgets_them) {
    for (const double force : {0.0, 1e-9}) {
        const Scratch folder;
        PulledChain chain(force);
        BOOST_TEST(run(folder, [&](Session& session) {
                       session.run_all<1>({chain_case(chain)});
                   }) == (force > 0.0 ? 1 : 0));
        BOOST_TEST(checked(folder) == (force > 0.0 ? "mass_drift !momentum_drift energy_drift"
                                                   : "mass_drift momentum_drift energy_drift"));
    }
}

BOOST_AUTO_TEST_CASE(and_once_where_it_does_not) {
    const Scratch folder;
    PulledChain sound(0.0), pulled(1e-9);
    BOOST_TEST(run(folder, [&](Session& session) {
                   const auto runs = session.run_all<1>(
                       {chain_case(sound, "sound"), chain_case(pulled, "pulled")});
                   session.check_promises(runs[0], "mine_");
               }) == 1);
    BOOST_TEST(checked(folder) ==
               "mine_mass_drift mine_momentum_drift mine_energy_drift "
               "pulled_mass_drift !pulled_momentum_drift pulled_energy_drift");
}

BOOST_AUTO_TEST_CASE(statistics_hold_every_invariant) {
    const Scratch folder;
    PulledChain chain(1e-9);
    run(folder, [&](Session& session) { session.run_all<1>({chain_case(chain)}); });
    const auto invariants = json_of(folder / "out/statistics.json").at("invariants");
    BOOST_TEST(invariants.size() == 3u);
    const auto& momentum = invariants.at("momentum");
    BOOST_TEST(momentum.at("promise") == "exact");
    BOOST_TEST(momentum.at("limit") == 1e-12);
    BOOST_TEST(momentum.at("kept") == false);
    const Csv rows(folder / "out/invariants.csv");
    const auto p = rows.column("momentum_x");
    BOOST_TEST(std::abs(p.back() - p.front()) == 1.6e-8, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(momentum.at("change").get<double>() * momentum.at("scale").get<double>() ==
                   std::abs(p.back() - p.front()),
               boost::test_tools::tolerance(1e-12));
    BOOST_TEST(invariants.at("energy").at("promise") == "to integrator error");
    BOOST_TEST(invariants.at("energy").at("limit") == 1e-6);
    BOOST_TEST(invariants.at("energy").at("kept") == true);
    BOOST_TEST(invariants.at("mass").at("change") == 0.0);
    BOOST_TEST(invariants.at("mass").at("scale") == 8.0);
}

BOOST_AUTO_TEST_CASE(no_result_that_is_no_number) {
    for (const double value : {double{NAN}, HUGE_VAL, -HUGE_VAL})
        for (const auto& expected : {std::optional<double>{}, std::optional<double>{0.0}}) {
            const Scratch folder;
            PulledChain chain(0.0);
            BOOST_TEST(run(folder, [&](Session& session) {
                           session.run_all<1>({chain_case(chain)});
                           session.check({"measure", value, expected, HUGE_VAL, "nobody"});
                       }) == 1);
            const auto first = json_of(folder / "out/result.json").at(0);
            BOOST_TEST(first.at("value").is_null());
            BOOST_TEST(first.at("holds") == false);
        }
}

BOOST_AUTO_TEST_CASE(claimed_where_it_is_known_and_else_only_measured) {
    for (const bool known : {true, false}) {
        const Scratch folder;
        PulledChain chain(0.0);
        BOOST_TEST(run(folder, [&](Session& session) {
                       session.run_all<1>({chain_case(chain)});
                       session.claim({"two", 2.0, 3.0, 0.5, "the author"}, known);
                       session.measure("three", 3.0);
                       // --dt was given.
                       BOOST_TEST(session.when_default({"t-end", "rtol"}));
                       BOOST_TEST(!session.when_default({"t-end", "dt"}));
                   }) == (known ? 1 : 0));
        const auto results = json_of(folder / "out/result.json");
        BOOST_TEST(results.at(0).at("source") == (known ? "the author" : "measured"));
        BOOST_TEST(results.at(0).at("expected").is_null() != known);
        BOOST_TEST(results.at(1).at("name") == "three");
    }
}

BOOST_AUTO_TEST_CASE(a_measure_that_is_no_number_leaves_its_cell_empty_and_is_named) {
    const Scratch folder;
    PulledChain chain(0.0);
    auto one = chain_case(chain);
    one.plan.record({{"root",
                      [](const Model<1>&, std::span<const double> y) {
                          return std::sqrt(y[8] - 0.09);  // the speed of the first falls from 0.1
                      }},
                     {"last", [](const Model<1>&, std::span<const double>) { return 1.0; }}});
    BOOST_TEST(run(folder, [&](Session& session) { session.run_all<1>({one}); }) == 0);
    const Csv rows(folder / "out/invariants.csv");
    BOOST_TEST(rows.names.at(7) == "root");
    BOOST_TEST(!rows.cells.front().at(7).empty());
    BOOST_TEST(rows.cells.back().at(7).empty());
    BOOST_TEST(rows.cells.back().at(8) == "1");
    const std::string text = contents_of(folder / "out/invariants.csv");
    BOOST_TEST(text.find("nan") == std::string::npos, text);
    const std::string events = contents_of(folder / "out/events.csv");
    BOOST_TEST(events.find("root is not a number") != std::string::npos, events);
    BOOST_TEST(events.find("root", events.find("root") + 1) == std::string::npos, events);
    BOOST_TEST(contents_of(folder / "out/run.log").find("root is no number") != std::string::npos);
}

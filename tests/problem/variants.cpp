// SPDX-License-Identifier: GPL-3.0-or-later
// Several cases of a problem of one's own: how they are called, run, kept for pictures and reported.
#include "problem/result_files.hpp"
#include <spam/material/harmonic_spring.hpp>
#include <spam/problem/findings.hpp>
#include <spam/problem/pictures.hpp>
#include <spam/problem/variant.hpp>
#include <spam/setup/drawn.hpp>
#include <spam/spam.hpp>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <functional>

using namespace spam;
using spam::test::json_of;
using spam::test::Scratch;

namespace {

struct Chain : Variant<1> {
    int masses = 0;
};

Chain make_chain(int masses) {
    Chain chain;
    chain.masses = masses;
    chain.model = std::make_shared<BondedModel<1>>(
        make_particles<1>(square_lattice<1>({masses}), 1.0), HarmonicSpring{});
    chain.y0 = initial_state<1>(*chain.model, 1.0, 1.0, [](const Point<1>& x) {
        return Point<1>(x[0] == 0.0 ? 0.1 : 0.0);
    });
    return chain;
}

int run(const Scratch& folder, const std::vector<std::string>& more,
        const std::function<void(Session&)>& body) {
    Problem problem("my_chains", "chains of springs");
    std::vector<std::string> words{"my_chains", "--quiet", "--no-plots",  "--dt",
                                   "0.05",      "--out",   folder / "out"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    return problem.main(static_cast<int>(arguments.size()), arguments.data(), body);
}

}  // namespace

BOOST_AUTO_TEST_CASE(cases_are_called_by_their_size_and_reported_under_it) {
    const Scratch folder;
    std::vector<Chain> chains;
    const int status = run(folder, {}, [&](Session& session) {
        chains = by_size(8, true, make_chain);
        const auto runs = run_all(session, chains, [&](Chain& chain) {
            Plan<1> plan{.t_end = session.end(2.0, 1.0), .snapshot_every = 0.5};
            chain.drawn = states_at<1>({0.0, 0.4}, 1.3);
            plan.observe(keep_nearest<1>(chain.drawn, [](const Model<1>& m, auto) {
                return std::vector<double>(m.particles().size(), 7.0);
            }));
            return plan;
        });
        std::vector<double> errors;
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const Findings findings(session, chains[k].prefix);
            errors.push_back(std::pow(0.5, static_cast<double>(2 * k)));
            findings.check("masses", static_cast<double>(runs[k].statistics.particles),
                           chains[k].masses, 0.0, "as many as asked for");
            findings.claim("unknown", 1.0, 2.0, 0.0, "nobody", false);
            findings.measure_last(runs[k].history, {"energy"});
            findings.check_promises(runs[k]);
        }
        Findings(session).measure_orders(labels_of(chains), errors, "made up");
    });
    BOOST_TEST(status == 0);
    const std::vector<std::string> labels{"4", "8", "16"};
    BOOST_TEST(labels_of(chains) == labels, boost::test_tools::per_element());
    for (const auto& label : labels)
        BOOST_TEST(std::filesystem::exists(folder / ("out/" + label + "/invariants.csv")));
    std::string names;
    for (const auto& item : json_of(folder / "out/result.json")) {
        const auto name = item.at("name").get<std::string>();
        names += name + ' ';
        if (name == "order_8_to_16") BOOST_TEST(item.at("value").get<double>() == 2.0);
        if (name == "8_unknown") BOOST_TEST(item.at("expected").is_null());
    }
    for (const char* name :
         {"4_masses ", "8_unknown ", "16_energy ", "16_momentum", "order_4_to_8 "})
        BOOST_TEST(names.find(name) != std::string::npos, name << " is missing in " << names);
    // Snapshots are half a unit of time apart: 0.52 takes that at 0.5.
    BOOST_TEST(chains[1].drawn[0].t == 0.0);
    BOOST_TEST(std::abs(chains[1].drawn[1].t - 0.5) < 1e-12);
    BOOST_TEST(chains[1].drawn[1].values.size() == 8U);
}

BOOST_AUTO_TEST_CASE(one_case_has_no_name_and_smoke_runs_have_values_of_their_own) {
    const Scratch folder;
    int masses = 8;
    std::vector<Chain> chains;
    const int status = run(folder, {"--smoke"}, [&](Session& session) {
        session.smoke_default("masses", masses, 5);
        chains = by_size(masses, false, make_chain);
        run_all(session, chains,
                [&](const Chain&) { return Plan<1>{.t_end = session.end(2.0, 1.0)}; });
    });
    BOOST_TEST(status == 0);
    BOOST_TEST(masses == 5);
    BOOST_TEST(chains.front().label.empty());
    BOOST_TEST(json_of(folder / "out/statistics.json").at("t_end").get<double>() == 1.0);
}

BOOST_AUTO_TEST_CASE(lattices_are_centred_displaced_and_made_one_body) {
    Points<2> x = centred<2>(cell_centres<2>({4, 2}));
    BOOST_TEST(x.rowwise().mean().norm() < 1e-15);
    BOOST_TEST(x(0, 0) == -1.5);
    const Points<2> lattice = x;
    displace(x, 0.0, 1);
    BOOST_TEST((x - lattice).norm() == 0.0);
    displace(x, 0.2, 1);
    BOOST_TEST((x - lattice).cwiseAbs().maxCoeff() <= 0.2);
    BOOST_TEST((x - lattice).cwiseAbs().maxCoeff() > 0.1);
    Points<2> again = lattice, other = lattice;
    displace(again, 0.2, 1);
    displace(other, 0.2, 2);
    BOOST_TEST((x - again).norm() == 0.0);
    BOOST_TEST((x - other).norm() > 0.0);
    x.col(0).array() += 100.0;
    BOOST_TEST(make_particles<2>(x, 1.0, 1.0, {}, 1.5).bodies() == 2);
    BOOST_TEST(one_body(make_particles<2>(x, 1.0, 1.0, {}, 1.5)).bodies() == 1);
}

BOOST_AUTO_TEST_CASE(curves_are_made_of_columns_and_formulas) {
    History h({"t", "energy"});
    h.add({0.0, 2.0});
    h.add({2.0, 6.0});
    const CurvePanel panel = over_time("title", h, "E", {{"all", "energy"}}, true);
    BOOST_TEST(panel.log_y);
    BOOST_TEST(panel.x_label == "t");
    BOOST_TEST(panel.curves.front().title == "all");
    BOOST_TEST(panel.curves.front().y.back() == 6.0);
    BOOST_TEST(h.mean_rate("energy", 0.5) == 2.0);
    const Curve squares = graph(
        "x²", 1.0, 3.0, 2, [](double value) { return value * value; }, 4);
    BOOST_TEST(squares.x == (std::vector{1.0, 2.0, 3.0}), boost::test_tools::per_element());
    BOOST_TEST(squares.y == (std::vector{1.0, 4.0, 9.0}), boost::test_tools::per_element());
    BOOST_TEST(divided(squares.y, 2.0).back() == 4.5);
    BOOST_TEST(rectangle({0.0, 1.0}, {2.0, 3.0}).col(2).x() == 2.0);
}

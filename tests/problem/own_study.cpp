// SPDX-License-Identifier: GPL-3.0-or-later
// Studies of integrators on a system of one's own: a chain of masses and springs in the plane, as a
// user's problem file would have it.
#include "problem/result_files.hpp"
#include <spam/material/harmonic_spring.hpp>
#include <spam/spam.hpp>
#include <spam/study/drift_study.hpp>
#include <spam/study/work_precision.hpp>

#include <boost/test/unit_test.hpp>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <typeinfo>

using namespace spam;
using spam::test::Csv;
using spam::test::json_of;
using spam::test::Scratch;

namespace {

/// Eight masses on a line, the first one pushed.
Start<1> chain() {
    Start<1> start{std::make_unique<BondedModel<1>>(make_particles<1>(square_lattice<1>({8}), 1.0),
                                                    HarmonicSpring{}),
                   {}};
    start.y0 = initial_state<1>(*start.model, 1.0, 1.0, [](const Point<1>& x) {
        return Point<1>(x[0] == 0.0 ? 0.3 : 0.0);
    });
    return start;
}

const Trial<1> ringing{"chain", "Chain of springs", chain, 10.0};

template <class Study>
int run(Study& study, const Scratch& folder, std::vector<std::string> words) {
    Problem problem("my_chain", "a chain of springs");
    study.standard_methods = {"rk4", "arkode:DORMAND_PRINCE_7_4_5"};
    study.add_options(problem.options());
    words.insert(words.begin(), "my_chain");
    words.insert(words.end(), {"--quiet", "--no-plots", "--out", (folder / "out").string()});
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    return problem.main(static_cast<int>(arguments.size()), arguments.data(),
                        [&](Session& session) { study.template run<1>(session, {ringing}); });
}

/// Value of what was measured under that name.
double measured(const nlohmann::json& results, const std::string& name) {
    for (const auto& item : results)
        if (item.at("name") == name) return item.at("value").get<double>();
    BOOST_FAIL("nothing named " << name);
    return 0.0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(errors_against_work) {
    const Scratch folder;
    WorkPrecision study;
    BOOST_TEST(run(study, folder, {"--calls", "20000"}) == 0);
    const auto results = json_of(folder / "out/result.json");
    BOOST_TEST(std::abs(measured(results, "chain_order_rk4") - 4.0) < 0.1);
    BOOST_TEST(std::abs(measured(results, "chain_order_dormand_prince_7_4_5") - 5.0) < 0.1);
    BOOST_TEST(measured(results, "chain_reference_error") < 1e-11);
    BOOST_TEST(measured(results, "chain_decades_of_error") > 6.0);

    const Csv table(folder / "out/integrator_accuracy.csv");
    std::size_t fixed = 0, adaptive = 0;
    double last = 0.0;
    for (std::size_t r = 0; r < table.cells.size(); ++r) {
        const auto cell = [&](const char* name) {
            const auto at = std::find(table.names.begin(), table.names.end(), name);
            return table.cells[r].at(static_cast<std::size_t>(at - table.names.begin()));
        };
        (cell("steps") == "fixed" ? fixed : adaptive) += 1;
        BOOST_TEST(Csv::number(cell("rhs_evaluations")) <= 22'000.0);
        BOOST_TEST(Csv::number(cell("seconds")) > 0.0);
        if (cell("end") != "measured") continue;
        const double error = Csv::number(cell("error"));
        BOOST_TEST(error >= Csv::number(cell("floor")));
        // The largest of the fields' errors, of those that there are.
        BOOST_TEST(
            error == std::max(Csv::number(cell("position_rms")), Csv::number(cell("velocity_rms"))),
            boost::test_tools::tolerance(1e-5));
        BOOST_TEST(cell("density_rms") == "");
        BOOST_TEST(Csv::number(cell("position_max")) >= Csv::number(cell("position_rms")));
        BOOST_TEST(Csv::number(cell("momentum_drift")) < 1e-13);
        last = error;
    }
    BOOST_TEST(fixed == 34u);     // two methods, factors of sqrt 2 from 1/256
    BOOST_TEST(adaptive == 11u);  // one of them, 1e-2 to 1e-12
    BOOST_TEST(last < 1e-9);
}

/// A force that is not what the others are: with a kink in it the orders claimed do not come out, and the
/// study says so.
BOOST_AUTO_TEST_CASE(a_claim_that_does_not_hold_fails) {
    struct Kinked final : Model<1> {
        explicit Kinked(Particles<1> particles)
            : Model<1>(std::move(particles), {}, {Field::position, Field::velocity}) {}
        void rates(double, std::span<const double> y, std::span<double> y_dot) override {
            y_dot[0] = y[1];
            y_dot[1] = -y[0] - (y[0] > 0.1 ? 0.7 : 0.0);
        }
        double internal_energy(std::span<const double> y) const override {
            return 0.5 * y[0] * y[0] + (y[0] > 0.1 ? 0.7 * (y[0] - 0.1) : 0.0);
        }
        Promises promises() const override { return {}; }
        std::string describe() const override { return "a force that jumps"; }
        std::size_t pairs() const override { return 0; }
        double reach() const override { return 1.0; }
    };
    const auto jumping = [] {
        return Start<1>{std::make_unique<Kinked>(make_particles<1>(square_lattice<1>({1}), 1.0)),
                        {0.0, 1.0}};
    };
    for (const std::string rough : {"", "its force jumps"}) {
        const Scratch folder;
        Problem problem("my_jump", "a force that jumps");
        WorkPrecision study;
        study.standard_methods = {"rk4"};
        study.add_options(problem.options());
        std::vector<std::string> words{
            "my_jump", "--quiet", "--no-plots", "--out", (folder / "out").string(),
            "--steps", "fixed"};
        std::vector<char*> arguments;
        for (auto& word : words) arguments.push_back(word.data());
        const int status =
            problem.main(static_cast<int>(arguments.size()), arguments.data(), [&](Session& s) {
                study.run<1>(s, {{"jump", "Jump", jumping, 20.0, rough}});
            });
        BOOST_TEST(status == (rough.empty() ? 1 : 0));
    }
}

BOOST_AUTO_TEST_CASE(drifts_in_long_runs) {
    const Scratch folder;
    DriftStudy study;
    BOOST_TEST(run(study, folder, {"--calls-per-time", "10"}) == 0);
    const auto results = json_of(folder / "out/result.json");
    BOOST_TEST(measured(results, "chain_rk4_momentum_drift") < 1e-14);
    BOOST_TEST(measured(results, "chain_rk4_energy_drift") < 1e-2);
    const Csv table(folder / "out/invariant_drift.csv");
    BOOST_TEST(table.cells.size() == 2u);
    for (const double calls : table.column("calls_per_time"))
        BOOST_TEST(calls == 10.0, boost::test_tools::tolerance(0.1));
    const Csv drifts(folder / "out/drifts/chain_rk4.csv");
    BOOST_TEST(drifts.column("t").back() == 10.0, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(drifts.column("energy").front() == 0.0);
}

BOOST_AUTO_TEST_CASE(methods_that_do_not_exist_are_refused) {
    for (const std::string list : {"rk5", "rk4,rk4", "rk4,,", "arkode:VERNER"}) {
        const Scratch folder;
        WorkPrecision study;
        BOOST_TEST(run(study, folder, {"--methods", list}) == 2, list);
        BOOST_TEST(folder.listing().empty());
    }
    const Scratch folder;
    WorkPrecision study;  // nothing left: rk4 has no steps of its own choice
    BOOST_TEST(run(study, folder, {"--methods", "rk4", "--steps", "adaptive"}) == 2);
    WorkPrecision another;  // steps are what is studied
    BOOST_TEST(run(another, folder, {"--dt", "0.1"}) == 2);
    BOOST_TEST(folder.listing().empty());
}

namespace {

/// Exit status of a problem with this body, and what it says on standard error.
std::pair<int, std::string> told(const std::function<void(Session&)>& body) {
    const Scratch folder;
    std::string file = folder / "err", out = "--out=" + (folder / "out").string();
    std::fflush(stderr);
    const int own = dup(2), to = open(file.c_str(), O_CREAT | O_WRONLY, 0600);
    dup2(to, 2);
    Problem problem("mine", "a problem");
    char name[] = "mine", quiet[] = "--quiet", no_plots[] = "--no-plots", step[] = "--dt=0.02";
    char* words[] = {name, quiet, no_plots, step, out.data()};
    const int status = problem.main(5, words, body);
    dup2(own, 2);
    close(own);
    close(to);
    return {status, spam::test::contents_of(file)};
}

/// The same where something is thrown at a row in the middle of a run, or after it.
std::pair<int, std::string> told_of_a_run(
    const std::function<void(double t)>& at_row, const std::function<void()>& afterwards = [] {}) {
    return told([&](Session& session) {
        auto start = chain();
        Plan<1> plan{.t_end = 2.0, .output_every = 0.5};
        plan.observe(
            {.on_row = [&](double t, const Model<1>&, std::span<const double>) { at_row(t); }});
        session.run<1>(*start.model, start.y0, std::move(plan));
        afterwards();
    });
}

}  // namespace

/// Status 2 says that nothing was written: what fails later is the run, and says what it was.
BOOST_AUTO_TEST_CASE(what_fails_in_the_middle_of_a_run_is_no_bad_input) {
    const auto one_line_with = [](const std::string& text, const std::string& words) {
        return text.find(words) != std::string::npos &&
               std::count(text.begin(), text.end(), '\n') == 1;
    };
    const std::pair<std::function<void()>, std::string> all[] = {
        {[] { throw std::bad_alloc(); }, "not enough memory to go on"},
        {[] { throw std::length_error("vector::reserve"); }, "(vector::reserve)"},
        {[] { throw InputError("range: too short"); }, "range: too short"}};
    for (const auto& [thrown, words] : all) {
        const auto [status, text] = told_of_a_run([thrown = thrown](double t) {
            if (t > 0.9) thrown();
        });
        BOOST_TEST(status == 3);
        BOOST_TEST(one_line_with(text, words), text);
        const auto [status_after, text_after] = told_of_a_run([](double) {}, thrown);
        BOOST_TEST(status_after == 3);
        BOOST_TEST(one_line_with(text_after, words), text_after);
    }
    BOOST_TEST(told_of_a_run([](double) {}).first == 0);
}

/// --quiet prints errors, and what decides the exit status is one.
BOOST_AUTO_TEST_CASE(a_check_that_fails_is_said_though_quiet) {
    const auto [status, text] = told([](Session& session) {
        auto start = chain();
        session.run<1>(*start.model, start.y0, {.t_end = 1.0});
        session.check({"speed_of_sound", 2.0, 1.0, 0.5, "springs"});
        session.check({"mass", 8.0, 8.0, 0.0, "eight of one"});
    });
    BOOST_TEST(status == 1);
    BOOST_TEST(text == "mine: FAIL  speed_of_sound = 2 (expected 1 +- 0.5)\n");
}

/// Status 4 says that results could not be written: what is neither that nor bad input says so.
BOOST_AUTO_TEST_CASE(an_unexpected_exception_is_called_a_defect) {
    const auto [status, text] = told([](Session&) { throw std::bad_cast(); });
    BOOST_TEST(status == 4);
    BOOST_TEST(text.starts_with("mine: a defect of this program"), text);
    BOOST_TEST(text.find("std::bad_cast") != std::string::npos, text);
    BOOST_TEST(std::count(text.begin(), text.end(), '\n') == 1);
    const auto [file_status, file_text] =
        told([](Session&) { std::filesystem::rename("/nonexistent/a", "/nonexistent/b"); });
    BOOST_TEST(file_status == 4);
    BOOST_TEST(file_text.find("defect") == std::string::npos, file_text);
    BOOST_TEST(file_text.find("No such file") != std::string::npos, file_text);
    const auto [memory_status, memory_text] =
        told([](Session&) { std::vector<double>().reserve(std::size_t(1) << 62); });
    BOOST_TEST(memory_status == 2);
    BOOST_TEST(memory_text.find("not enough memory") != std::string::npos, memory_text);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// What no step can pass, in a problem of one's own: each run stops within its limits, says why, leaves
// complete results and a checkpoint; gone on with, it stops again.
#include "problem/result_files.hpp"
#include <spam/io/checkpoint_pair.hpp>
#include <spam/material/harmonic_spring.hpp>
#include <spam/spam.hpp>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <limits>

using namespace spam;
using spam::test::Csv;
using spam::test::json_of;
using spam::test::Scratch;

namespace {

enum class Fault { none, poisoned, stiff, noisy };

/// Eight masses and springs on a line, with a fault from t = 5 on.
class FaultyChain final : public Model<1> {
  public:
    explicit FaultyChain(Fault fault)
        : Model<1>(make_particles<1>(square_lattice<1>({8}), 1.0), {},
                   {Field::position, Field::velocity}),
          chain_(particles(), HarmonicSpring{}),
          fault_(fault) {}

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override {
        chain_.rates(t, y, y_dot);
        ++calls_;
        const State<1> rate(layout(), y_dot);
        if (t <= 5.0) return;
        if (fault_ == Fault::poisoned)
            rate.velocity()(0, 3) = std::numeric_limits<double>::quiet_NaN();
        if (fault_ == Fault::stiff)
            rate.velocity()(0, 3) -= 1e30 * ConstState<1>(layout(), y).position()(0, 3);
        if (fault_ == Fault::noisy) rate.velocity()(0, 3) += calls_ % 2 == 0 ? 1e30 : -1e30;
    }
    double internal_energy(std::span<const double> y) const override {
        return chain_.internal_energy(y);
    }
    Promises promises() const override { return chain_.promises(); }
    std::string describe() const override { return "a chain that breaks at t = 5"; }
    std::size_t pairs() const override { return chain_.pairs(); }
    double reach() const override { return chain_.reach(); }

  private:
    BondedModel<1> chain_;
    Fault fault_;
    std::size_t calls_ = 0;
};

int run(Fault fault, const Scratch& folder, std::vector<std::string> words) {
    Problem problem("faulty_chain", "a chain of springs that breaks");
    words.insert(words.begin(), "faulty_chain");
    words.insert(words.end(), {"--quiet", "--no-plots", "--out", (folder / "out").string()});
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    return problem.main(
        static_cast<int>(arguments.size()), arguments.data(), [&](Session& session) {
            FaultyChain chain(fault);
            auto y0 = initial_state<1>(chain, 1.0, 1.0, [](const Point<1>& x) {
                return Point<1>(x[0] == 0.0 ? 0.1 : 0.0);
            });
            Plan<1> plan;
            plan.t_end = 10.0;
            session.check_promises(session.run(chain, std::move(y0), std::move(plan)));
        });
}

const std::vector<std::vector<std::string>> methods{
    {},
    {"--integrator", "arkode:DORMAND_PRINCE_7_4_5"},
    {"--integrator", "gsl:rkf45"},
    {"--integrator", "cvode:adams"},
};

void check_stops(Fault fault, const std::string& says, const std::vector<std::string>& method) {
    const Scratch folder;
    BOOST_TEST(run(fault, folder, method) == 3);
    const auto stopped = json_of(folder / "out/statistics.json").at("stopped").get<std::string>();
    BOOST_TEST_MESSAGE(stopped);
    BOOST_TEST(stopped.find(says) != std::string::npos, stopped);
    const double t = Csv(folder / "out/invariants.csv").column("t").back();
    BOOST_TEST(t > 4.0);
    BOOST_TEST(t < 10.0);
    const auto newest = newest_checkpoint(folder / "out");
    BOOST_REQUIRE(newest);
    BOOST_TEST(CheckpointReader(*newest).numbers("/cases/0/t").at(0) == t);
    BOOST_TEST(run(fault, folder, {"--restart", newest->string()}) == 3);
}

}  // namespace

BOOST_AUTO_TEST_CASE(without_a_fault_it_goes_to_the_end) {
    for (const auto& method : methods) {
        const Scratch folder;
        BOOST_TEST(run(Fault::none, folder, method) <= 1);  // 1: drifts of loose tolerances
        BOOST_TEST(Csv(folder / "out/invariants.csv").column("t").back() == 10.0);
    }
}

BOOST_AUTO_TEST_CASE(a_rate_that_is_not_a_number_from_some_time_on) {
    // Where a method looks at rates again, the first is named; else what came of it.
    const std::vector<std::string> says{"the rate of velocity_x of particle 3",
                                        "the rate of velocity_x of particle 3", "nan", "step"};
    for (std::size_t k = 0; k < methods.size(); ++k)
        check_stops(Fault::poisoned, says[k], methods[k]);
}

BOOST_AUTO_TEST_CASE(a_spring_that_forces_tiny_steps) {
    for (std::size_t k = 1; k < methods.size(); ++k) check_stops(Fault::stiff, "step", methods[k]);
}

BOOST_AUTO_TEST_CASE(steps_that_are_rejected_without_end) {
    for (std::size_t k = 1; k < methods.size(); ++k) check_stops(Fault::noisy, "step", methods[k]);
}

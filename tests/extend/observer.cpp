// SPDX-License-Identifier: GPL-3.0-or-later
// An observer of one's own, in one file: how far the particles have moved, the largest speed of all
// snapshots, and an end of the run where they have moved far enough.
#include <spam/core/error.hpp>
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
namespace {

struct Spreading {
    double largest_speed = 0.0;

    static double distance(const Model<2>& model, std::span<const double> y) {
        const Points<2>& from = model.particles().reference_position;
        return (ConstState<2>(model.layout(), y).position() - from).norm();
    }
    Observer<2> observer(double far) {
        return {.columns = {{"distance", distance}},
                .on_snapshot =
                    [this](double, const Model<2>& model, std::span<const double> y) {
                        const auto v = ConstState<2>(model.layout(), y).velocity();
                        largest_speed = std::max(largest_speed, v.cwiseAbs().maxCoeff());
                    },
                .enough = [far](const History& h) { return h.last("distance") > far; },
                .memory = [this](Archive& archive) { archive(largest_speed); }};
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_moving_body_is_watched_until_it_is_far_enough) {
    const auto model = std::make_shared<BondedModel<2>>(
        make_particles<2>(triangular_block(6, 5), 1.0), HarmonicSpring{});
    auto y0 =
        initial_state<2>(*model, 1.0, 1.0, [](const Point<2>&) { return Point<2>(0.5, 0.0); });
    Spreading spreading;
    Plan<2> plan{.t_end = 10.0, .output_every = 0.5, .snapshot_every = 2.0};
    plan.observe(spreading.observer(10.0));
    plan.record({closest_pair_column<2>()});
    IntegratorOptions options;
    options.dt = 0.1;
    const RunRecord run = run_in_memory<2>({model, std::move(y0), std::move(plan)}, options);
    // sqrt(30) 0.5 t > 10 at the row after t = 3.65
    BOOST_TEST(run.complete);
    BOOST_TEST(run.statistics.t_end == 4.0, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(run.history.last("distance") == std::sqrt(30.0) * 2.0,
               boost::test_tools::tolerance(1e-9));
    BOOST_TEST(spreading.largest_speed == 0.5, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(columns_of_a_name_that_exists_are_refused) {
    const auto model = std::make_shared<BondedModel<2>>(
        make_particles<2>(triangular_block(2, 2), 1.0), HarmonicSpring{});
    const auto y0 = initial_state<2>(*model, 1.0, 1.0, at_rest<2>());
    IntegratorOptions options;
    options.dt = 0.1;
    for (const std::string name : {"t", "dt", "energy", "momentum_x", "own"}) {
        const auto run = [&] {
            Plan<2> plan{.t_end = 1.0, .output_every = 0.5, .snapshot_every = 1.0};
            plan.record({{"own", Spreading::distance}, {name, Spreading::distance}});
            run_in_memory<2>({model, y0, std::move(plan)}, options);
        };
        BOOST_CHECK_EXCEPTION(run(), InputError, [&](const InputError& refusal) {
            return std::string(refusal.what()).find("'" + name + "'") != std::string::npos;
        });
    }
}

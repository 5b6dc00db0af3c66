// SPDX-License-Identifier: GPL-3.0-or-later
// The energy of leapfrog swings by what the step makes of it, and no more: it is judged by dt^2 at any step.
#include <spam/material/polynomial_solid.hpp>
#include <spam/problem/run_in_memory.hpp>
#include <spam/rhs/material_vectors.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;

namespace {

std::shared_ptr<Model<2>> springs() {
    return std::make_shared<BondedModel<2>>(make_particles<2>(triangular_hexagon(3), 1.0),
                                            HarmonicSpring{});
}
std::shared_ptr<Model<2>> material_vectors() {
    return std::make_shared<MaterialVectorModel<2>>(
        make_particles<2>(triangular_hexagon(3), 1.0),
        PolynomialSolid::like(ElasticSolid::triangular_lattice()),
        MaterialVectorScheme{std::sqrt(4.0 / 3.0), 3.0, 2.0});
}

/// Of a body that turns and shakes, its velocity multiplied by 1 + `kick` at every row.
Drift energy_of(const std::shared_ptr<Model<2>>& model, double dt, double shake, double kick) {
    auto y0 = initial_state<2>(*model, std::sqrt(4.0 / 3.0), 1.0, [shake](const Point<2>& x) {
        return Point<2>(-0.03 * x.y() + shake * std::sin(2.0 * x.x()), 0.03 * x.x());
    });
    Plan<2> plan{.t_end = 60.0, .output_every = 1.0, .snapshot_every = 60.0};
    if (kick != 0.0)
        plan.observe({.revise = [kick](double, const Model<2>& m, std::span<double> y) {
            State<2>(m.layout(), y).velocity() *= 1.0 + kick;
            return true;
        }});
    const IntegratorOptions leapfrog{.method = "leapfrog", .dt = dt};
    return run_in_memory<2>({model, std::move(y0), std::move(plan)}, leapfrog).drifts.back();
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_energy_of_leapfrog_is_kept_at_any_step) {
    for (const auto& make : {springs, material_vectors})
        for (const double shake : {0.0, 0.02})
            for (const double dt : {0.4, 0.2, 0.1, 0.02}) {
                const Drift energy = energy_of(make(), dt, shake, 0.0);
                BOOST_TEST_CONTEXT("dt " << dt << ", shaken by " << shake << ": " << energy.change
                                         << " of " << energy.limit) {
                    BOOST_TEST(energy.name == "energy");
                    BOOST_TEST(energy.kept());
                    // No looser than twenty times what is found, where that is above what others may change.
                    BOOST_TEST(energy.limit < std::max(1.1e-6, 20.0 * energy.change));
                }
            }
}

/// What gives energy is found, at a step whose swing is a hundred times what other methods are allowed.
BOOST_AUTO_TEST_CASE(energy_that_comes_from_nowhere_is_not_kept) {
    for (const auto& make : {springs, material_vectors}) {
        const Drift energy = energy_of(make(), 0.1, 0.02, 1e-3);
        BOOST_TEST(!energy.kept(), energy.change << " of " << energy.limit);
    }
}

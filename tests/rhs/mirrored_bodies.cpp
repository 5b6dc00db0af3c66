// SPDX-License-Identifier: GPL-3.0-or-later
// Solids whose neighbours stay (total-Lagrangian ones, springs) at mirrors.
#include "support/mirrored.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/material/smooth_hencky_solid.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/rhs/total_lagrangian.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
void bodies_with_neighbours_for_good() {
    const TotalLagrangianScheme scheme{.density = 1.0, .range = 2.6, .penalty = 0.3};
    const Build<Dim> solid = [&](Particles<Dim> particles, const Box<Dim>& box) {
        return std::make_unique<TotalLagrangianModel<Dim>>(
            std::move(particles), StVenantKirchhoff{0.7, 0.4}, scheme, box);
    };
    const Build<Dim> springs = [](Particles<Dim> particles, const Box<Dim>& box) {
        return std::make_unique<BondedModel<Dim>>(std::move(particles), HarmonicSpring{}, box);
    };
    for (const auto* build : {&solid, &springs})
        for (const int steps : {0, 20}) BOOST_TEST_CONTEXT(Dim << "D, " << steps << " steps")
    BOOST_TEST(against_symmetric_whole<Dim>(*build, steps) < 1e-12);
}

}  // namespace

// Mirrors are planes of symmetry for them.
BOOST_AUTO_TEST_CASE(solids_with_neighbours_for_good_are_half_of_a_symmetric_whole) {
    bodies_with_neighbours_for_good<1>();
    bodies_with_neighbours_for_good<2>();
    bodies_with_neighbours_for_good<3>();
    const Build<2> yields = [](Particles<2> particles, const Box<2>& box) {
        return std::make_unique<TotalLagrangianModel<2>>(
            std::move(particles), SmoothHenckySolid<PlaneStrainVonMises>({0.7, 0.4}, {0.05, 0.1}),
            TotalLagrangianScheme{.density = 1.0, .range = 2.6}, box);
    };
    BOOST_TEST(against_symmetric_whole<2>(yields) < 1e-12);
}

// One that flies to a mirror is turned back at it, and the mirror's impulse and the body's energy are accounted for.
BOOST_AUTO_TEST_CASE(a_solid_flies_to_a_mirror) {
    Points<2> x = square_lattice<2>({4, 4});
    x.colwise() -= x.rowwise().minCoeff().eval();
    x.array() += 0.6;
    Box<2> box;
    box.set_wall(0, false, {WallKind::mirror, -4.0});
    TotalLagrangianModel<2> model(make_particles<2>(x, 1.0), StVenantKirchhoff{0.7, 0.4},
                                  {.density = 1.0, .range = 2.6}, box);
    std::vector<double> y(model.layout().size(), 0.0);
    const State<2> state(model.layout(), y);
    state.position() = x;
    state.velocity().row(0).setConstant(-0.5);
    Motion<2> motion(model, y, {.method = "rk4", .dt = 0.01});
    const auto before = measure_invariants<2>(model, motion.y());
    motion.advance_to(25.0);
    const auto after = measure_invariants<2>(model, motion.y());
    const auto v = ConstState<2>(model.layout(), motion.y()).velocity();
    BOOST_TEST(v.row(0).mean() > 0.15);  // the rest is in its vibrations
    BOOST_TEST(model.reflections() >= 4U);
    BOOST_TEST(std::abs(after.energy - before.energy) < 1e-6 * before.energy);
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-10);
}

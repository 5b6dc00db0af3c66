// SPDX-License-Identifier: GPL-3.0-or-later
// Several laws in one body, in one file: two materials side by side, and cores that keep particles apart, under
// gravity. What gravity gives is booked, and the accounts close.
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/external/gravity.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
namespace {

/// The closest pair of a body whose right half is soft after it has been pressed together.
double closest_pair_of(double core) {
    auto particles = make_particles<2>(triangular_block(8, 8), 1.0);
    particles.material.resize(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.material[i] = particles.reference_position(0, Eigen::Index(i)) < 4.0 ? 0 : 1;
    const std::vector<Material<2>> solids{ElasticSolid{0.43, 0.43}, ElasticSolid{0.04, 0.04}};

    ParticleModel<2> body(particles);
    body.add_term<SmoothParticles<2>>(solids, Scheme{});
    if (core > 0.0) body.add_term<Core<2>>(CorePotential{core, 0.7});
    body.add(std::make_unique<Gravity<2>>(Point<2>(0.0, -1e-3)));

    const auto y0 = initial_state<2>(
        body, 1.1547, 0.43, [](const Point<2>& x) { return Point<2>(-0.2 * (x.x() - 4.0), 0.0); });
    Motion<2> motion(body, y0, {.method = "rk4", .dt = 0.02});
    const auto before = measure_invariants<2>(body, y0);
    motion.advance_to(8.0);
    const auto after = measure_invariants<2>(body, motion.y());
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-11);
    BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) < 1e-6);
    return closest_pair<2>(motion.state().position(), 1.0, Box<2>{});
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_core_keeps_particles_of_two_materials_apart) {
    const double without = closest_pair_of(0.0), with = closest_pair_of(0.5);
    BOOST_TEST(with > without + 0.05);
    BOOST_TEST(with > 0.3);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of bodies: particles of two bodies repel each other as a core says, those of one do not see each other;
// what it gives keeps p, L and E.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/diagnostics/invariants.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/contact.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

constexpr CorePotential core{0.7, 1.3};

/// Three bodies, two of them mixed up with each other.
template <int Dim>
Particles<Dim> mixed() {
    auto particles = jittered_particles<Dim>(Dim == 3 ? 5 : 9, 11);
    for (std::size_t i = 0; i < particles.size(); ++i)
        particles.body[i] = static_cast<std::int32_t>(i % 7 == 0 ? 2 : i % 2);
    return particles;
}

template <int Dim>
void check_against_all_pairs() {
    ParticleModel<Dim> model(mixed<Dim>());
    model.template add_term<Contact<Dim>>(core);
    const auto y = random_state(model, 12);
    const auto rates = rates_of(model, y);
    const auto found = ConstState<Dim>(model.layout(), rates).velocity();
    const auto x = ConstState<Dim>(model.layout(), y).position();
    const auto& p = model.particles();
    double energy = 0.0, largest = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        Point<Dim> force = Point<Dim>::Zero();
        for (Eigen::Index j = 0; j < x.cols(); ++j) {
            if (p.body[static_cast<std::size_t>(i)] == p.body[static_cast<std::size_t>(j)])
                continue;
            const Point<Dim> r = x.col(i) - x.col(j);
            force += core.force_over_r(r.squaredNorm()) * r;
            energy += 0.5 * core.energy(r.squaredNorm());
        }
        const double m = p.mass[static_cast<std::size_t>(i)];
        BOOST_TEST((found.col(i) - force / m).norm() < 1e-12);
        largest = std::max(largest, force.norm());
    }
    BOOST_TEST(largest > 0.1);
    BOOST_TEST(std::abs(model.internal_energy(y) - energy) < 1e-12 * energy);
}

}  // namespace

BOOST_AUTO_TEST_CASE(pairs_of_two_bodies_and_no_others) {
    check_against_all_pairs<1>();
    check_against_all_pairs<2>();
    check_against_all_pairs<3>();
}

BOOST_AUTO_TEST_CASE(bodies_that_meet_part_again_and_keep_everything) {
    Points<2> x(2, 2 * 19);
    x << triangular_hexagon(2), triangular_hexagon(2).colwise() + Point<2>(7.0, 1.0);
    auto particles = make_particles<2>(x, 1.0);
    BOOST_TEST(particles.bodies() == 2);
    ParticleModel<2> model(particles);
    model.add_term<Springs<2>>(HarmonicSpring{});
    model.add_term<Contact<2>>(CorePotential{0.3, 1.0});
    const auto y0 = initial_state<2>(model, 1.0, 1.0, [](const Point<2>& at) {
        return Point<2>(at.x() > 3.5 ? -0.1 : 0.1, 0.0);
    });
    IntegratorOptions rk4;
    rk4.dt = 0.05;
    Motion<2> motion(model, y0, rk4);
    motion.advance_to(60.0);
    const auto before = measure_invariants<2>(model, y0),
               after = measure_invariants<2>(model, motion.y());
    BOOST_TEST((after.momentum - before.momentum).norm() < 1e-12);
    BOOST_TEST(std::abs(after.angular_momentum[0] - before.angular_momentum[0]) < 1e-8);
    BOOST_TEST(std::abs(after.energy / before.energy - 1.0) < 1e-6);
    const auto v = motion.state().velocity();
    double left = 0.0;
    for (Eigen::Index i = 0; i < v.cols(); ++i)
        if (particles.body[static_cast<std::size_t>(i)] == particles.body[0])
            left += v(0, i) / 19.0;
    const bool begins_left = particles.reference_position(0, 0) < 3.5;
    BOOST_TEST((begins_left ? left : -left) < -0.05);  // it has been thrown back
}

BOOST_AUTO_TEST_CASE(a_contact_that_would_not_push_is_refused) {
    ParticleModel<2> model(mixed<2>());
    BOOST_CHECK_THROW(model.add_term<Contact<2>>(CorePotential{0.0, 1.0}), InputError);
    BOOST_CHECK_THROW(model.add_term<Contact<2>>(CorePotential{1.0, -1.0}), InputError);
}

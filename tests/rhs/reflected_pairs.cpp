// SPDX-License-Identifier: GPL-3.0-or-later
// The distance of closest approach beside laws that have no scheme, and beside particles that are held or driven.
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/shape.hpp>
#include <spam/external/clamp.hpp>
#include <spam/material/st_venant_kirchhoff.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/reflected_pairs.hpp>
#include <spam/rhs/total_lagrangian.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace spam;

// Two fly to one that moves with a prescribed velocity: v becomes 2 V - v across the line of the centres, and what
// holds it books 2 m (V - v), its moment and its work.
BOOST_AUTO_TEST_CASE(what_is_held_or_driven_reflects_as_an_infinite_mass) {
    for (const double V : {0.0, 0.3}) {
        Points<2> x(2, 3);
        x << 0.0, 3.0, -0.2, 0.5, 0.5, -4.0;
        Particles<2> particles = make_particles<2>(x, 1.0, 1.0);
        for (std::size_t i = 0; i < 3; ++i)
            particles.mass[i] = 1.0 + static_cast<double>(particles.id[i]);
        ParticleModel<2> model(particles);
        model.add_term<ReflectedPairs<2>>(0.5);
        const auto stored = [&](int id) {
            const auto& ids = model.particles().id;
            return static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
        };
        Group group(3, 0);
        group[stored(0)] = 1;
        model.add(std::make_unique<Clamp<2>>(
            group, [V](double) { return Point<2>(V, 0.0); },
            [](double) { return Point<2>::Zero().eval(); }));
        std::vector<double> y0(model.layout().size());
        const State<2> state(model.layout(), y0);
        state.position() = model.particles().reference_position;
        state.velocity().col(static_cast<Eigen::Index>(stored(0))) << V, 0.0;
        state.velocity().col(static_cast<Eigen::Index>(stored(1))) << -1.0, 0.0;
        state.velocity().col(static_cast<Eigen::Index>(stored(2))) << V, 1.0;
        IntegratorOptions rk4;
        rk4.dt = 0.1;
        Motion<2> motion(model, y0, rk4);
        const auto before = measure_invariants<2>(model, motion.y());
        motion.advance_to(3.0);
        const auto in_front = motion.state().velocity().col(static_cast<Eigen::Index>(stored(1)));
        BOOST_TEST(in_front[0] == 2.0 * V + 1.0, boost::test_tools::tolerance(1e-14));
        motion.advance_to(6.0);
        const auto after = measure_invariants<2>(model, motion.y());
        const auto below = motion.state().velocity().col(static_cast<Eigen::Index>(stored(2)));
        BOOST_TEST(below[1] < 0.0);  // reflected, at a slant
        BOOST_TEST(motion.statistics().events == 2u);
        BOOST_TEST(std::abs(after.angular_momentum[0] - before.angular_momentum[0]) > 0.1);
        for (int a = 0; a < 2; ++a)
            BOOST_TEST(std::abs(after.momentum_balance()[a] - before.momentum_balance()[a]) <
                       1e-13);
        BOOST_TEST(std::abs(after.angular_momentum_balance()[0] -
                            before.angular_momentum_balance()[0]) < 1e-12);
        BOOST_TEST(std::abs(after.energy_balance() - before.energy_balance()) < 1e-13);
        BOOST_TEST((std::abs(after.energy - before.energy) > 0.1) == (V != 0.0));
    }
}

BOOST_AUTO_TEST_CASE(reflections_where_nothing_moves_or_along_one_axis) {
    const auto with = [](std::unique_ptr<Clamp<2>> clamp) {
        auto model = std::make_unique<ParticleModel<2>>(
            make_particles<2>(square_lattice<2>({3, 3}), 1.0, 1.0));
        model->add_term<ReflectedPairs<2>>(0.5);
        model->add(std::move(clamp));
        return model;
    };
    BOOST_TEST(with(std::make_unique<Clamp<2>>())->events().empty());
    auto guided = std::make_unique<Clamp<2>>();
    guided->only_along(0);
    BOOST_CHECK_THROW(with(std::move(guided))->events(), InputError);
}

BOOST_AUTO_TEST_CASE(distances_without_meaning_are_refused) {
    ParticleModel<2> model(make_particles<2>(square_lattice<2>({3, 3}), 1.0, 1.0));
    for (const double distance : {0.0, -0.5, 1.0, std::nan("")})
        BOOST_CHECK_THROW(model.add_term<ReflectedPairs<2>>(distance), InputError);
    const Box<2> narrow({3.0, 1.0});
    ParticleModel<2> periodic(make_particles<2>(square_lattice<2>({3, 1}), 1.0, 1.0, narrow),
                              narrow);
    BOOST_CHECK_THROW(periodic.add_term<ReflectedPairs<2>>(0.6), InputError);
}

// A ring of solid that keeps its reference flies into another: without the term particles come nearer than R.
BOOST_AUTO_TEST_CASE(solids_that_keep_their_reference_do_not_come_nearer) {
    const auto closest = [](double R) {
        Points<2> x = square_lattice<2>({8, 4});
        for (Eigen::Index i = 0; i < x.cols(); ++i)
            if (x(0, i) > 4.0) x(0, i) += 2.0;
        ParticleModel<2> model(make_particles<2>(x, 1.0, 1.0));
        model.add_term<TotalLagrangian<2>>(StVenantKirchhoff{0.43, 0.43},
                                           TotalLagrangianScheme{1.0, 2.5});
        if (R > 0.0) model.add_term<ReflectedPairs<2>>(R);
        const auto y0 = initial_state<2>(model, 1.0, 0.43, [](const Point<2>& at) {
            return Point<2>(at[0] > 5.0 ? -0.3 : 0.3, 0.0);
        });
        IntegratorOptions rk4;
        rk4.dt = 0.1;
        Motion<2> motion(model, y0, rk4);
        const auto before = measure_invariants<2>(model, motion.y());
        double least = 1e300;
        for (double t = 0.5; t < 20.0; t += 0.5) {
            motion.advance_to(t);
            least = std::min(least, closest_pair<2>(motion.state().position(), 1.0, {}));
        }
        const auto after = measure_invariants<2>(model, motion.y());
        BOOST_TEST((after.momentum - before.momentum).norm() < 1e-12);
        BOOST_TEST(std::abs(after.energy - before.energy) < 1e-3 * before.energy);
        BOOST_TEST((motion.statistics().events > 0u) == (R > 0.0));
        return least;
    };
    BOOST_TEST(closest(0.0) < 0.5);
    BOOST_TEST(closest(0.7) > 0.7 - 1e-9);
}

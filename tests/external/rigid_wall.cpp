// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid wall throws back what comes, along its normal alone; at rest it keeps the energy, and moving it
// books the work that it does.
#include "support/refusal.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/rigid_wall.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/particle_model.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace spam;
using spam::test::refusal;

namespace {

constexpr double energy = 0.8, range = 0.7;

/// One particle of mass 1.6 and nothing but walls.
template <int Dim>
Particles<Dim> one_particle() {
    Particles<Dim> particles;
    particles.mass = {1.6};
    particles.id = {0};
    particles.body = {0};
    particles.reference_position = Points<Dim>::Zero(Dim, 1);
    return particles;
}

template <int Dim>
struct Alone {
    ParticleModel<Dim> model{one_particle<Dim>()};
    std::vector<double> y;

    explicit Alone(std::unique_ptr<External<Dim>> wall, const Point<Dim>& x, const Point<Dim>& v) {
        model.add(std::move(wall));
        y.resize(model.layout().size());
        const State<Dim> state(model.layout(), y);
        state.position().col(0) = x;
        state.velocity().col(0) = v;
    }
    /// After rk4 until t.
    void run(double t) {
        IntegratorOptions options;
        options.dt = 0.01;
        Motion<Dim> motion(model, y, options);
        motion.advance_to(t);
        y.assign(motion.y().begin(), motion.y().end());
    }
    Point<Dim> position() const { return ConstState<Dim>(model.layout(), y).position().col(0); }
    Point<Dim> velocity() const { return ConstState<Dim>(model.layout(), y).velocity().col(0); }
    Point<Dim> force() {
        std::vector<double> rates(y.size());
        model.rates(0.0, y, rates);
        return 1.6 * ConstState<Dim>(model.layout(), rates).velocity().col(0);
    }
};

template <int Dim>
Point<Dim> direction() {
    Point<Dim> n;
    for (int a = 0; a < Dim; ++a) n[a] = a == 0 ? 0.6 : a == 1 ? -0.8 : 0.3;
    return n;
}

template <int Dim>
void throws_back() {
    const Point<Dim> n = direction<Dim>().normalized(), v = -0.5 * n + 0.2 * Point<Dim>::Ones();
    Alone<Dim> alone(std::make_unique<RigidWall<Dim>>(3.0 * n, -2.0, energy, range),
                     Point<Dim>::Zero(), v);
    const auto before = measure_invariants<Dim>(alone.model, alone.y);
    // Where it turns its motion along the normal is all potential.
    const double v_n = n.dot(v), deepest = range * (1.0 - std::pow(0.8 * v_n * v_n / energy, 0.25));
    double nearest = 10.0;
    for (int k = 0; k < 400 && nearest > n.dot(alone.position()) + 2.0; ++k) {
        nearest = n.dot(alone.position()) + 2.0;
        alone.run(0.02);
    }
    BOOST_TEST(std::abs(nearest - deepest) < 1e-3);
    alone.run(10.0);
    BOOST_TEST((alone.velocity() - (v - 2.0 * v_n * n)).norm() < 1e-7);
    const auto after = measure_invariants<Dim>(alone.model, alone.y);
    BOOST_TEST(std::abs(after.energy - before.energy) < 1e-8);
    BOOST_TEST((after.momentum_balance() - before.momentum_balance()).norm() < 1e-12);
    BOOST_TEST(after.work == 0.0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_comes_is_thrown_back) {
    throws_back<1>();
    throws_back<2>();
    throws_back<3>();
}

BOOST_AUTO_TEST_CASE(its_force_is_the_slope_of_its_potential) {
    const Point<2> n = direction<2>().normalized();
    for (const double d : {-0.5, 0.0, 0.2, 0.6, 0.69, 0.7, 0.9}) {
        Alone<2> alone(std::make_unique<RigidWall<2>>(n, 0.4, energy, range), (d + 0.4) * n,
                       Point<2>::Zero());
        const auto potential = [&](double more) {
            const State<2> state(alone.model.layout(), alone.y);
            state.position().col(0) = (d + 0.4 + more) * n;
            const double result = alone.model.internal_energy(alone.y);
            state.position().col(0) = (d + 0.4) * n;
            return result;
        };
        const double h = 1e-5, slope = (potential(h) - potential(-h)) / (2.0 * h);
        BOOST_TEST((alone.force() + slope * n).norm() < 1e-8);
        BOOST_TEST((alone.force().norm() > 0.0) == (d < range));
    }
}

/// A wall of speed V hits a particle at rest, which leaves with 2 V.
BOOST_AUTO_TEST_CASE(a_moving_wall_books_its_work) {
    const double V = 0.25;
    Alone<2> alone(std::make_unique<RigidWall<2>>(
                       Point<2>(1.0, 0.0), [=](double t) { return V * t - 2.0; }, energy, range),
                   Point<2>::Zero(), Point<2>(0.0, 0.1));
    alone.run(40.0);
    BOOST_TEST((alone.velocity() - Point<2>(2.0 * V, 0.1)).norm() < 1e-7);
    const auto after = measure_invariants<2>(alone.model, alone.y);
    BOOST_TEST(std::abs(after.work - 0.5 * 1.6 * 4.0 * V * V) < 1e-7);
    BOOST_TEST(std::abs(after.energy_balance() - 0.5 * 1.6 * 0.01) < 1e-9);
    BOOST_TEST(std::abs(after.impulse[0] - 1.6 * 2.0 * V) < 1e-7);
    BOOST_TEST(after.impulse[1] == 0.0);
    BOOST_TEST(!alone.model.inseparable().empty());
    BOOST_TEST(alone.model.describe() == "a rigid wall that moves, across x");
}

BOOST_AUTO_TEST_CASE(walls_that_make_no_sense) {
    const auto refused = [](const Point<2>& n, double at, double e, double s) {
        return refusal([&] { RigidWall<2>(n, at, e, s); });
    };
    BOOST_TEST(refused({1.0, 0.0}, 0.0, 1.0, 1.0) == "accepted");
    BOOST_TEST(refused({0.0, 0.0}, 0.0, 1.0, 1.0).find("wall: a plane") == 0U);
    BOOST_TEST(refused({1.0, 0.0}, double(NAN), 1.0, 1.0).find("wall: a plane") == 0U);
    for (const double bad : {0.0, -1.0, double(NAN), double(INFINITY)}) {
        BOOST_TEST(refused({1.0, 0.0}, 0.0, bad, 1.0).find("wall: energy") == 0U);
        BOOST_TEST(refused({1.0, 0.0}, 0.0, 1.0, bad).find("wall: energy") == 0U);
    }
}

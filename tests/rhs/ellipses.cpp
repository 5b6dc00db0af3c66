// SPDX-License-Identifier: GPL-3.0-or-later
// Particles as ellipses: what their forces keep, how shapes follow a motion, and what is refused.
#include "support/random_state.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/material/lucy_gas.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/ellipses.hpp>

#include <Eigen/Dense>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

template <int Dim>
using Square = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
Square<Dim> shape_of(const ParticleModel<Dim>& model, std::span<const double> y, Eigen::Index i) {
    const double* const G =
        ConstState<Dim>(model.layout(), y).find(field_kind::shape) + symmetric_size(Dim) * i;
    Square<Dim> shape;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b)
            shape(a, b) = G[symmetric_index(Dim, std::min(a, b), std::max(a, b))];
    return shape;
}
template <int Dim>
void set_shape(const State<Dim>& state, Eigen::Index i, const Square<Dim>& shape) {
    double* const G = state.find(field_kind::shape) + symmetric_size(Dim) * i;
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) G[symmetric_index(Dim, a, b)] = shape(a, b);
}

/// Stretched and sheared by 3.
template <int Dim>
Square<Dim> deformation() {
    Square<Dim> F = Square<Dim>::Identity();
    F(0, 0) = 3.0;
    if constexpr (Dim > 1) F(0, 1) = 3.0;
    return F;
}

template <int Dim>
struct Gas {
    explicit Gas(int cells, const EllipseScheme& scheme = {.range = 2.6}, double jitter = 0.15)
        : model(jittered_particles<Dim>(cells, 41, jitter)),
          law(model.template add_term<Ellipses<Dim>>(Fluid{GammaGas{1.4}}, scheme)) {
        auto random = random_state(model, 42);
        const State<Dim> state(model.layout(), random);
        y = law.start(model.particles().reference_position, state.velocity(), 1.0);
    }
    ParticleModel<Dim> model;
    Ellipses<Dim>& law;
    std::vector<double> y;
};

/// Ellipses of all kinds, each one other than its neighbours'.
template <int Dim>
void forces_keep_everything(int cells) {
    Gas<Dim> gas(cells);
    const State<Dim> state(gas.model.layout(), gas.y);
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        Square<Dim> H = Square<Dim>::Identity() / 2.6;
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) H(a, b) += 0.05 * std::sin(1.7 * double(i) + a + 2.3 * b);
        set_shape<Dim>(state, i, H.transpose() * H);
    }
    const auto y_dot = rates_of(gas.model, gas.y);
    const ConstState<Dim> rate(gas.model.layout(), y_dot);
    Point<Dim> force = Point<Dim>::Zero();
    double torque = 0.0, power = 0.0, forces = 0.0, torques = 0.0, powers = 0.0;
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        const double m = gas.model.particles().mass[static_cast<std::size_t>(i)];
        const Point<Dim> F = m * rate.velocity().col(i), x = state.position().col(i);
        force += F;
        forces += F.norm();
        if constexpr (Dim > 1) torque += x[0] * F[1] - x[1] * F[0];
        torques += x.norm() * F.norm();
        const double work = state.velocity().col(i).dot(F), heat = m * rate.energy()(0, i);
        power += work + heat;
        powers += std::abs(work) + std::abs(heat);
    }
    BOOST_TEST(forces > 1.0);
    BOOST_TEST(force.norm() < 1e-14 * forces);
    BOOST_TEST(std::abs(torque) < 1e-14 * torques);
    BOOST_TEST(std::abs(power) < 1e-14 * powers);
}

/// A lattice whose ellipses are deformed with it has the densities that it had, by 1/|F|; and shapes follow v = A x.
template <int Dim>
void shapes_follow(int cells) {
    Gas<Dim> gas(cells);
    const State<Dim> state(gas.model.layout(), gas.y);
    const auto before = gas.model.density(gas.y);
    const Square<Dim> F = deformation<Dim>(), back = F.inverse();
    state.position() = (F * state.position()).eval();
    for (Eigen::Index i = 0; i < state.position().cols(); ++i)
        set_shape<Dim>(state, i, back.transpose() * shape_of<Dim>(gas.model, gas.y, i) * back);
    const auto after = gas.model.density(gas.y);
    double worst = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i)
        worst = std::max(worst, std::abs(after[i] * F.determinant() / before[i] - 1.0));
    BOOST_TEST(worst < 1e-12);

    Square<Dim> A;
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b) A(a, b) = std::cos(2.0 + 3.0 * a + b);
    state.velocity() = A * state.position();
    const auto y_dot = rates_of(gas.model, gas.y);
    worst = 0.0;
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        const Square<Dim> G = shape_of<Dim>(gas.model, gas.y, i);
        const Square<Dim> G_dot = shape_of<Dim>(gas.model, y_dot, i);
        worst = std::max(worst, (G_dot + A.transpose() * G + G * A).norm() / G.norm());
    }
    BOOST_TEST(worst < 1e-11);
}

}  // namespace

BOOST_AUTO_TEST_CASE(forces_of_any_ellipses_keep_p_L_and_E) {
    forces_keep_everything<1>(40);
    forces_keep_everything<2>(12);
    forces_keep_everything<3>(6);
}

BOOST_AUTO_TEST_CASE(shapes_follow_the_motion) {
    shapes_follow<1>(40);
    shapes_follow<2>(12);
    shapes_follow<3>(6);
}

// The density is an invariant of the motion that shapes follow, and E falls with the step as RK4 does.
BOOST_AUTO_TEST_CASE(energy_to_the_order_of_the_integrator) {
    std::vector<double> error;
    for (const double dt : {0.2, 0.1}) {
        Gas<2> gas(10);
        State<2>(gas.model.layout(), gas.y).velocity() *= 0.1;
        const double E = measure_invariants<2>(gas.model, gas.y).energy_balance();
        Motion<2> motion(gas.model, gas.y, {.method = "rk4", .dt = dt});
        motion.advance_to(4.0);
        error.push_back(
            std::abs(measure_invariants<2>(gas.model, motion.y()).energy_balance() / E - 1.0));
    }
    BOOST_TEST(error[1] < 1e-5);
    BOOST_TEST(error[0] > 8.0 * error[1]);
}

// A limit of the aspect changes shapes, not the energy.
BOOST_AUTO_TEST_CASE(aspects_have_a_limit) {
    const auto widest = [](double limit) {
        Gas<2> gas(10, {.range = 2.6, .largest_aspect = limit});
        const State<2> state(gas.model.layout(), gas.y);
        state.velocity().row(0) = 0.5 * state.position().row(0);
        state.velocity().row(1) = -0.1 * state.position().row(1);
        const double E = measure_invariants<2>(gas.model, gas.y).energy_balance();
        Motion<2> motion(gas.model, gas.y, {.method = "rk4", .dt = 0.05});
        motion.advance_to(3.0);
        BOOST_TEST(std::abs(measure_invariants<2>(gas.model, motion.y()).energy_balance() / E -
                            1.0) < 1e-6);
        return gas.law.largest_aspect(motion.y());
    };
    BOOST_TEST(widest(HUGE_VAL) > 2.0);
    BOOST_TEST(widest(1.5) <= 1.5 * (1.0 + 1e-9));
}

// Next to the surface, where the density falls to the outside, axes along the gradient begin shorter.
BOOST_AUTO_TEST_CASE(axes_by_the_gradient) {
    const Gas<2> round(10, {.range = 2.6}, 0.0),
        flat(10, {.range = 2.6, .gradient_share = 0.5}, 0.0);
    BOOST_TEST(round.law.largest_aspect(round.y) == 1.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(flat.law.largest_aspect(flat.y) > 1.3);
    const auto& x = flat.model.particles().reference_position;
    Eigen::Index left = 0;  // in the middle of a side
    (x.colwise() - Point<2>(0.0, 0.5 * x.row(1).maxCoeff())).colwise().norm().minCoeff(&left);
    const auto G = shape_of<2>(flat.model, flat.y, left);
    BOOST_TEST(G(0, 0) > 1.5 * G(1, 1));
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto refused = [](const Fluid& fluid, const EllipseScheme& scheme,
                            const Box<2>& box = {}) {
        ParticleModel<2> model(jittered_particles<2>(8, 43, 0.15, box), box);
        BOOST_CHECK_THROW(model.add_term<Ellipses<2>>(fluid, scheme), InputError);
    };
    const Fluid gas{GammaGas{1.4}};
    refused(gas, {.range = 0.5});
    refused(gas, {.gradient_share = -1.0});
    refused(gas, {.largest_aspect = 1.0});
    refused({LucyGas{}}, {});
    refused({GammaGas{1.4}, NewtonViscosity{0.1, 0.1}}, {});
    refused(gas, {}, Box<2>({8.0, 8.0}));
    Box<2> walled;
    walled.set_wall(0, false, {WallKind::mirror, -5.0});
    refused(gas, {}, walled);
}

// Far from each other nothing pulls; neighbours on one line leave the shape across it open.
BOOST_AUTO_TEST_CASE(too_few_neighbours) {
    Gas<2> gas(6);
    const State<2> state(gas.model.layout(), gas.y);
    const Points<2> dense = state.position();
    state.position() = 100.0 * dense;
    state.velocity().setZero();
    const auto y_dot = rates_of(gas.model, gas.y);
    BOOST_TEST(ConstState<2>(gas.model.layout(), y_dot).velocity().norm() == 0.0);
    state.position().row(0) = dense.row(0);
    state.position().row(1).setZero();
    const auto nowhere = rates_of(gas.model, gas.y);
    BOOST_TEST(!ConstState<2>(gas.model.layout(), nowhere).velocity().allFinite());
}

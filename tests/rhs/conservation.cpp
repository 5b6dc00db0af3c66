// SPDX-License-Identifier: GPL-3.0-or-later
// What the right-hand side keeps for any state, all schemes, 1 to 3 dimensions; and that each of
// the properties can fail.
#include "support/effort.hpp"
#include "support/oracle_model.hpp"
#include "support/random_state.hpp"
#include <spam/physics/torque_balance.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

const ElasticSolid solid{0.7, 0.4};

template <int Dim>
int cells() {
    return Dim == 1 ? 20 : Dim == 2 ? 7 : 4;
}

/// |d/dt sum m (e + v^2/2)| relative to the sum of the magnitudes of its terms.
template <int Dim>
double energy_residual(Model<Dim>& model, unsigned seed) {
    const auto y = random_state(model, seed);
    const auto y_dot = rates_of(model, y);
    const ConstState<Dim> s(model.layout(), y), r(model.layout(), y_dot);
    double sum = 0.0, size = 0.0;
    for (Eigen::Index i = 0; i < s.position().cols(); ++i) {
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        const double heat = m * r.energy()(0, i);
        const double work = m * s.velocity().col(i).dot(r.velocity().col(i));
        sum += heat + work;
        size += std::abs(heat) + std::abs(work);
    }
    return std::abs(sum) / size;
}

template <int Dim>
double momentum_residual(Model<Dim>& model, unsigned seed) {
    const auto y = random_state(model, seed);
    const auto y_dot = rates_of(model, y);
    const ConstState<Dim> r(model.layout(), y_dot);
    Point<Dim> sum = Point<Dim>::Zero();
    double size = 0.0;
    for (Eigen::Index i = 0; i < r.velocity().cols(); ++i) {
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        sum += m * r.velocity().col(i);
        size += m * r.velocity().col(i).norm();
    }
    return sum.norm() / size;
}

template <class V>
Eigen::Vector3d in_space(const V& a) {
    Eigen::Vector3d r = Eigen::Vector3d::Zero();
    r.head(a.size()) = a;
    return r;
}

/// |dL/dt| of one body relative to the size of its terms: about the origin, or about its centre and as seen
/// from there.
template <int Dim>
double torque_residual(Model<Dim>& model, unsigned seed, int body, bool own_frame = false) {
    auto y = random_state(model, seed);
    auto y_dot = rates_of(model, y);
    const State<Dim> s(model.layout(), y), r(model.layout(), y_dot);
    Point<Dim> X = Point<Dim>::Zero(), V = X, U = X;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double mass = 0.0, size = 0.0;
    for (Eigen::Index i = 0; own_frame && i < s.position().cols(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (model.particles().body[k] != body) continue;
        const double m = model.particles().mass[k];
        mass += m;
        X += m * s.position().col(i);
        V += m * s.velocity().col(i);
        U += m * r.position().col(i);
    }
    if (own_frame) {
        s.position().colwise() -= X / mass;
        s.velocity().colwise() -= V / mass;
        r.position().colwise() -= U / mass;
    }
    for (Eigen::Index i = 0; i < s.position().cols(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (model.particles().body[k] != body) continue;
        const auto x = s.position().col(i), v = s.velocity().col(i);
        const auto u = r.position().col(i), a = r.velocity().col(i);
        const Eigen::Vector3d orbital = model.particles().mass[k] * in_space(u).cross(in_space(v));
        const Eigen::Vector3d torque = model.particles().mass[k] * in_space(x).cross(in_space(a));
        sum += orbital + torque;
        size += orbital.norm() + torque.norm();
    }
    return sum.norm() / size;
}

template <int Dim>
void check_energy_and_momentum(Kernel kernel = Kernel::lucy) {
    for (const Scheme& scheme : all_schemes<Dim>(kernel)) {
        BOOST_TEST_CONTEXT(scheme.describe()) {
            SmoothParticleModel<Dim> model(jittered_particles<Dim>(cells<Dim>(), 1), solid, scheme);
            BOOST_TEST(energy_residual(model, 2) < 1e-14);
            BOOST_TEST(momentum_residual(model, 2) < 1e-14);
            const auto wrong =
                oracle_model<Dim>(model.particles(), solid, scheme, Mutation::full_work);
            BOOST_TEST(energy_residual<Dim>(*wrong, 2) > 1e-3);
            const auto lopsided =
                oracle_model<Dim>(model.particles(), solid, scheme, Mutation::half_list);
            BOOST_TEST(momentum_residual<Dim>(*lopsided, 2) > 1e-3);
        }
    }
}

/// Two jittered blocks out of each other's reach.
template <int Dim>
Particles<Dim> two_blocks() {
    const auto one = jittered_particles<Dim>(Dim == 2 ? 6 : 4, 5);
    Point<Dim> apart = Point<Dim>::Constant(3.0);
    apart[0] = 20.0;
    Points<Dim> both(Dim, 2 * one.reference_position.cols());
    both << one.reference_position, (0.9 * one.reference_position).colwise() + apart;
    return make_particles<Dim>(both, 1.3);
}

template <int Dim>
void check_angular_momentum(Kernel kernel) {
    for (Scheme scheme : all_schemes<Dim>(kernel)) {
        if (scheme.angular_momentum == AngularMomentum::free) continue;
        BOOST_TEST_CONTEXT(scheme.describe()) {
            SmoothParticleModel<Dim> model(two_blocks<Dim>(), solid, scheme);
            BOOST_TEST_REQUIRE(model.particles().bodies() == 2);
            const bool gauss = scheme.angular_momentum == AngularMomentum::gauss;
            BOOST_TEST(torque_residual(model, 3, 0, gauss) < 1e-13);
            BOOST_TEST(torque_residual(model, 3, 1, gauss) < 1e-13);
            if (Dim == 2 && !gauss)
                BOOST_TEST(model.torque_scales()[0].negative != model.torque_scales()[1].negative);
            scheme.angular_momentum = AngularMomentum::free;
            SmoothParticleModel<Dim> unbalanced(two_blocks<Dim>(), solid, scheme);
            BOOST_TEST(torque_residual(unbalanced, 3, 0) > 1e-4);
        }
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(energy_and_momentum_1d) { check_energy_and_momentum<1>(); }
BOOST_AUTO_TEST_CASE(energy_and_momentum_2d) { check_energy_and_momentum<2>(); }
BOOST_AUTO_TEST_CASE(energy_and_momentum_3d) { check_energy_and_momentum<3>(); }
BOOST_AUTO_TEST_CASE(energy_and_momentum_with_other_weight_functions) {
    for (const Kernel kernel :
         effort(std::vector{Kernel::monaghan, Kernel::w2, Kernel::w5}, std::vector{Kernel::w5})) {
        check_energy_and_momentum<1>(kernel);
        check_energy_and_momentum<2>(kernel);
        check_energy_and_momentum<3>(kernel);
    }
}

BOOST_AUTO_TEST_CASE(balanced_torques_work_in_the_energy) {
    Scheme scheme{.angular_momentum = AngularMomentum::torque_pair, .range = 2.6};
    const auto wrong =
        oracle_model<2>(jittered_particles<2>(7, 1), solid, scheme, Mutation::work_before_scaling);
    BOOST_TEST(energy_residual<2>(*wrong, 2) > 1e-4);
}

BOOST_AUTO_TEST_CASE(every_constraint_keeps_the_angular_momentum_of_every_body) {
    check_angular_momentum<2>(Kernel::lucy);
    check_angular_momentum<2>(Kernel::w5);
    check_angular_momentum<3>(Kernel::lucy);
    check_angular_momentum<3>(Kernel::w5);
}

BOOST_AUTO_TEST_CASE(a_global_balance_keeps_the_sum_and_no_body) {
    for (const auto law :
         {AngularMomentum::gauss, AngularMomentum::torque_particle, AngularMomentum::torque_pair}) {
        const Scheme scheme{.angular_momentum = law, .balance = Balance::global, .range = 2.6};
        BOOST_TEST_CONTEXT(scheme.describe()) {
            SmoothParticleModel<2> model(two_blocks<2>(), solid, scheme);
            BOOST_TEST(torque_residual(model, 3, 0) > 1e-5);
            model.set_bodies(std::vector<std::int32_t>(model.particles().size(), 0));
            BOOST_TEST(torque_residual(model, 3, 0) < 1e-13);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_fragment_of_two_particles_keeps_its_angular_momentum) {
    // It has one torque, and nothing to balance it with.
    Points<2> points(2, 2);
    points << 5.0, 6.1, -3.0, -2.7;
    for (const auto law : {AngularMomentum::torque_particle, AngularMomentum::torque_pair})
        for (const auto transport : {Transport::plain, Transport::monaghan}) {
            Scheme scheme{.transport = transport, .angular_momentum = law, .range = 2.6};
            SmoothParticleModel<2> model(make_particles<2>(points, 1.0), solid, scheme);
            BOOST_TEST(torque_residual(model, 3, 0) < 1e-13);
            scheme.angular_momentum = AngularMomentum::free;
            SmoothParticleModel<2> unbalanced(make_particles<2>(points, 1.0), solid, scheme);
            BOOST_TEST(torque_residual(unbalanced, 3, 0) > 1e-4);
        }
}

BOOST_AUTO_TEST_CASE(bodies_found_anew_are_kept_from_then_on) {
    SmoothParticleModel<2> model(two_blocks<2>(), solid,
                                 {.angular_momentum = AngularMomentum::torque_pair, .range = 2.6});
    const auto bodies = model.particles().body;
    model.set_bodies(std::vector<std::int32_t>(bodies.size(), 0));
    BOOST_TEST(torque_residual(model, 3, 0) < 1e-13);
    model.set_bodies(bodies);
    BOOST_TEST(torque_residual(model, 3, 0) < 1e-13);
    BOOST_TEST(torque_residual(model, 3, 1) < 1e-13);
}

BOOST_AUTO_TEST_CASE(that_the_constraint_works_is_remarked_once_also_after_a_restart) {
    const Scheme scheme{.angular_momentum = AngularMomentum::gauss, .range = 2.6};
    const auto particles = jittered_particles<2>(7, 1);
    SmoothParticleModel<2> model(particles, solid, scheme), again(particles, solid, scheme);
    auto y = random_state(model, 8);
    const State<2> state(model.layout(), y);
    for (Eigen::Index i = 0; i < state.position().cols(); ++i)  // much to keep
        state.velocity().col(i) += Point<2>(-state.position()(1, i), state.position()(0, i));
    BOOST_TEST(model.watch(1.0, y).size() == 1U);
    BOOST_TEST(model.watch(2.0, y).empty());
    Archive written;
    model.remember(written);
    Archive reading(written.bytes());
    again.remember(reading);
    reading.expect_end();
    BOOST_TEST(again.watch(3.0, y).empty());
}

BOOST_AUTO_TEST_CASE(the_average_velocity_needs_its_own_term_in_the_balance) {
    Scheme scheme{.transport = Transport::average,
                  .angular_momentum = AngularMomentum::torque_pair,
                  .range = 2.6};
    const auto wrong = oracle_model<2>(two_blocks<2>(), solid, scheme, Mutation::without_X);
    BOOST_TEST(torque_residual(*wrong, 3, 0) > 1e-5);
}

BOOST_AUTO_TEST_CASE(monaghan_transport_keeps_momentum_and_has_no_orbital_term) {
    Scheme scheme{.transport = Transport::monaghan, .range = 2.6};
    const auto orbital_and_momentum = [](Model<2>& model) {
        const auto y = random_state(model, 7);
        const auto y_dot = rates_of(model, y);
        const ConstState<2> s(model.layout(), y), r(model.layout(), y_dot);
        double orbital = 0.0;
        Point<2> shift = Point<2>::Zero();
        for (Eigen::Index i = 0; i < s.position().cols(); ++i) {
            const double m = model.particles().mass[static_cast<std::size_t>(i)];
            const auto u = r.position().col(i), v = s.velocity().col(i);
            orbital += m * (u[0] * v[1] - u[1] * v[0]);
            shift += m * (u - v);
        }
        return std::max(std::abs(orbital), shift.norm());
    };
    SmoothParticleModel<2> monaghan(jittered_particles<2>(7, 1), solid, scheme);
    BOOST_TEST(orbital_and_momentum(monaghan) < 1e-12);
    scheme.transport = Transport::average;
    SmoothParticleModel<2> average(jittered_particles<2>(7, 1), solid, scheme);
    BOOST_TEST(orbital_and_momentum(average) > 1e-3);
}

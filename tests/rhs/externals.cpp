// SPDX-License-Identifier: GPL-3.0-or-later
// A friction has neither force nor torque where it should not, and takes energy; models say what acts on
// them; rates do not depend on threads. The virial stress of springs is that of the elastic solid they
// make.
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/external/drag.hpp>
#include <spam/external/friction.hpp>
#include <spam/external/gravity.hpp>
#include <spam/external/thermostat.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace spam;

namespace {

constexpr double friction_gamma = 0.3;

std::unique_ptr<ParticleModel<2>> disk() {
    return std::make_unique<BondedModel<2>>(make_particles<2>(triangular_disk(4.0), 1.5),
                                            HarmonicSpring{});
}
std::unique_ptr<ParticleModel<3>> block() {
    return std::make_unique<BondedModel<3>>(make_particles<3>(square_lattice<3>({4, 3, 5}), 1.5),
                                            HarmonicSpring{});
}

/// Positions and velocities a bit off those of a body that drifts and turns.
template <int Dim>
std::vector<double> moving_state(Model<Dim>& model, double disorder) {
    auto y = initial_state<Dim>(model, 1.0, 1.0, [](const Point<Dim>& x) {
        Point<Dim> v = Point<Dim>::Constant(0.3);
        v[0] -= 0.05 * x[1];
        v[1] += 0.05 * x[0];
        return v;
    });
    std::mt19937 random(5);
    std::uniform_real_distribution<double> small(-disorder, disorder);
    const State<Dim> state(model.layout(), y);
    for (auto& number : state.position().reshaped()) number += small(random);
    for (auto& number : state.velocity().reshaped()) number += small(random);
    return y;
}

/// What one external gives, by the accounts, and the largest change it makes to a rate.
template <int Dim>
struct Effect {
    Point<Dim> force;
    Eigen::Matrix<double, Dim*(Dim - 1) / 2, 1> torque;
    double power, heat, largest;
};

template <int Dim>
Effect<Dim> effect_of(std::unique_ptr<ParticleModel<Dim>> model,
                      std::unique_ptr<ParticleModel<Dim>> plain,
                      std::unique_ptr<External<Dim>> external, double disorder) {
    const auto y_plain = moving_state<Dim>(*plain, disorder);
    model->add(std::move(external));
    const auto y = moving_state<Dim>(*model, disorder);
    std::vector<double> with(y.size()), without(y_plain.size());
    model->rates(0.0, y, with);
    plain->rates(0.0, y_plain, without);
    const State<Dim> rate(model->layout(), with), before(plain->layout(), without);
    BOOST_TEST((rate.position() == before.position()));
    return {rate.field(Field::impulse), rate.field(Field::angular_impulse),
            rate.field(Field::work)(0, 0), rate.field(Field::heat)(0, 0),
            (rate.velocity() - before.velocity()).cwiseAbs().maxCoeff()};
}

Effect<2> friction(double disorder, FrictionOf of = FrictionOf::internal_motion) {
    return effect_of<2>(disk(), disk(), std::make_unique<Friction<2>>(friction_gamma, of),
                        disorder);
}
Effect<3> friction_in_space(double disorder) {
    return effect_of<3>(block(), block(), std::make_unique<Friction<3>>(friction_gamma), disorder);
}

}  // namespace

BOOST_AUTO_TEST_CASE(friction_has_no_force_and_no_torque_and_takes_energy) {
    const Effect<2> e = friction(0.1);
    BOOST_TEST(e.force.norm() < 1e-13);
    BOOST_TEST(e.torque.norm() < 1e-12);
    BOOST_TEST(e.power < -0.01);
    BOOST_TEST(e.heat == 0.0);
    BOOST_TEST(e.largest > 0.01);
    const Effect<3> in_space = friction_in_space(0.1);
    BOOST_TEST(in_space.force.norm() < 1e-13);
    BOOST_TEST(in_space.torque.norm() < 1e-12);
    BOOST_TEST(in_space.power < -0.01);
    BOOST_TEST(in_space.largest > 0.01);
}

/// The mutated law of the one before, which has both; and a law of its own.
BOOST_AUTO_TEST_CASE(friction_of_all_velocity_takes_momentum_as_well) {
    const Effect<2> e = friction(0.1, FrictionOf::all_motion);
    const auto plain = disk();
    const auto now = measure_invariants<2>(*plain, moving_state<2>(*plain, 0.1));
    BOOST_TEST((e.force + friction_gamma * now.momentum).norm() < 1e-13 * now.momentum.norm());
    BOOST_TEST(std::abs(e.torque[0] + friction_gamma * now.angular_momentum[0]) <
               1e-13 * std::abs(now.angular_momentum[0]));
    BOOST_TEST(std::abs(e.power + 2.0 * friction_gamma * now.kinetic) < 1e-13 * now.kinetic);
}

BOOST_AUTO_TEST_CASE(rigid_motion_is_left_alone) {
    BOOST_TEST(friction(0.0).largest < 1e-15);
    BOOST_TEST(friction_in_space(0.0).largest < 1e-15);
}

BOOST_AUTO_TEST_CASE(a_model_says_what_acts_on_it) {
    auto model = disk();
    const auto plain = model->promises();
    const double damping = model->fastest_damping({});
    BOOST_TEST(model->inseparable().empty());
    model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.5)));
    BOOST_TEST(model->inseparable().empty());
    model->add(std::make_unique<Friction<2>>(friction_gamma, FrictionOf::all_motion));
    BOOST_TEST((model->promises().energy == plain.energy));
    BOOST_TEST((model->promises().momentum == plain.momentum));
    BOOST_TEST(model->fastest_damping({}) == damping + friction_gamma);
    BOOST_TEST(!model->inseparable().empty());
    BOOST_TEST(
        model->describe().ends_with("; gravity (0, -0.5); friction gamma = 0.3 of all motion"),
        model->describe());
    BOOST_CHECK_THROW(Friction<2>(-0.1), InputError);
    BOOST_CHECK_THROW(Friction<2>(std::nan("")), InputError);
    BOOST_CHECK_THROW(Thermostat<2>(0.0, 1.0), InputError);
    BOOST_CHECK_THROW(Thermostat<2>(1.0, -1.0), InputError);
    BOOST_CHECK_THROW(Drag<2>(-1.0, 1.0), InputError);
    BOOST_CHECK_THROW(Gravity<2>(Point<2>(0.0, HUGE_VAL)), InputError);
}

BOOST_AUTO_TEST_CASE(rates_do_not_depend_on_the_number_of_threads) {
    auto model = std::make_unique<BondedModel<2>>(make_particles<2>(triangular_hexagon(30), 1.0),
                                                  HarmonicSpring{});
    model->add(std::make_unique<Friction<2>>(0.2));
    model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -0.01)));
    const auto y = moving_state<2>(*model, 0.1);
    std::vector<double> one(y.size()), three(y.size());
    const int threads = set_threads(1);
    model->rates(0.0, y, one);
    set_threads(3);
    model->rates(0.0, y, three);
    set_threads(threads);
    BOOST_TEST(one == three, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(virial_stress_is_that_of_the_elastic_solid) {
    BondedModel<2> model(make_particles<2>(triangular_disk(4.0), 1.0), HarmonicSpring{});
    const double e = 1e-6, xx = 3.0 * e, yy = 0.5 * e, xy = 2.0 * e;
    std::vector<double> y(model.layout().size(), 0.0);
    auto x = State<2>(model.layout(), y).position();
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const Point<2> X = model.particles().reference_position.col(i);
        x.col(i) << X.x() + xx * X.x() + xy * X.y(), X.y() + xy * X.x() + yy * X.y();
    }
    Mat<2> strain;
    strain(0, 0) = xx, strain(1, 1) = yy, strain(0, 1) = strain(1, 0) = xy;
    const auto expected = ElasticSolid::triangular_lattice().stress_rate(strain, SymTensor<2>{});
    const auto stress = model.law.stress(y, std::sqrt(0.75));
    for (std::size_t i = 0; i < stress.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        if (model.particles().reference_position.col(at).norm() > 3.0) continue;  // six bonds
        for (std::size_t k = 0; k < 3; ++k)
            BOOST_TEST(stress[i].c[k] == expected.c[k], boost::test_tools::tolerance(1e-4));
    }
}

BOOST_AUTO_TEST_CASE(disks_hold_every_site_within_their_radius) {
    BOOST_TEST(triangular_disk(0.0).cols() == 1);
    BOOST_TEST(triangular_disk(1.0).cols() == 7);
    BOOST_TEST(triangular_disk(std::sqrt(3.0)).cols() == 13);
    BOOST_TEST(triangular_disk(8.0).cols() == 241);  // the ball of [HH07]
    BOOST_TEST(triangular_disk(16.0, 2.0).cols() == 241);
    BOOST_TEST(triangular_disk(12.3).colwise().norm().maxCoeff() <= 12.3);
    // Sites on the rim itself, by whole numbers: |a e_1 + b e_2|^2 = a^2 + a b + b^2.
    for (int square = 1; square <= 150; ++square) {
        int sites = 0;
        for (int a = -15; a <= 15; ++a)
            for (int b = -15; b <= 15; ++b) sites += a * a + a * b + b * b <= square ? 1 : 0;
        for (const double spacing : {1.0, 0.7, 0.01})
            BOOST_TEST(triangular_disk(std::sqrt(square) * spacing, spacing).cols() == sites);
    }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The friction of DampedModel has neither force nor torque, takes energy from everything that is not
// rigid motion, and nothing from rigid motion; the one against all motion is that. The virial stress of springs is that of the elastic
// solid they make.
#include <spam/core/error.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/bonded_model.hpp>
#include <spam/rhs/damped_model.hpp>
#include <spam/rhs/smooth_particle_model.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace spam;

namespace {

constexpr double friction_gamma = 0.3;

std::unique_ptr<Model<2>> disk() {
    return std::make_unique<BondedModel<2>>(make_particles<2>(triangular_disk(4.0), 1.5),
                                            HarmonicSpring{});
}

/// Positions and velocities a bit off those of a body that drifts and turns.
std::vector<double> moving_state(Model<2>& model, double disorder) {
    auto y = initial_state<2>(model, 1.0, 1.0, [](const Point<2>& x) {
        return Point<2>(0.4 - 0.05 * x.y(), -0.2 + 0.05 * x.x());
    });
    std::mt19937 random(5);
    std::uniform_real_distribution<double> small(-disorder, disorder);
    for (double& number : y) number += small(random);
    return y;
}

struct Effect {
    Point<2> force;
    double torque, power, largest;
};

/// Of the friction alone, given the accelerations it adds.
Effect effect_of(const Model<2>& model, std::span<const double> y, const Points<2>& added) {
    const ConstState<2> state(model.layout(), y);
    const auto x = state.position(), v = state.velocity();
    Effect e{Point<2>::Zero(), 0.0, 0.0, added.cwiseAbs().maxCoeff()};
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        e.force += m * added.col(i);
        e.torque += m * (x(0, i) * added(1, i) - x(1, i) * added(0, i));
        e.power += m * added.col(i).dot(v.col(i));
    }
    return e;
}

Effect friction(double disorder, Friction against = Friction::internal_motion) {
    const auto plain = disk();
    DampedModel damped(disk(), friction_gamma, against);
    const auto y = moving_state(damped, disorder);
    std::vector<double> with(y.size()), without(y.size());
    damped.rates(0.0, y, with);
    plain->rates(0.0, y, without);
    const Points<2> added =
        State<2>(damped.layout(), with).velocity() - State<2>(damped.layout(), without).velocity();
    BOOST_TEST((State<2>(damped.layout(), with).position() ==
                State<2>(damped.layout(), without).position()));
    return effect_of(damped, y, added);
}

}  // namespace

BOOST_AUTO_TEST_CASE(friction_has_no_force_and_no_torque_and_takes_energy) {
    const Effect e = friction(0.1);
    BOOST_TEST(e.force.norm() < 1e-13);
    BOOST_TEST(std::abs(e.torque) < 1e-12);
    BOOST_TEST(e.power < -0.01);
    BOOST_TEST(e.largest > 0.01);
}

/// The mutated law of the one before, which has both; and a law of its own.
BOOST_AUTO_TEST_CASE(friction_of_all_velocity_takes_momentum_as_well) {
    const Effect e = friction(0.1, Friction::all_motion);
    BOOST_TEST(e.force.norm() > 1.0);
    BOOST_TEST(std::abs(e.torque) > 1.0);
    const auto plain = disk();
    const auto y = moving_state(*plain, 0.1);
    const Points<2> added = -friction_gamma * ConstState<2>(plain->layout(), y).velocity();
    const Effect expected = effect_of(*plain, y, added);
    BOOST_TEST((e.force - expected.force).norm() < 1e-13 * expected.force.norm());
    BOOST_TEST(std::abs(e.torque - expected.torque) < 1e-13 * std::abs(expected.torque));
    BOOST_TEST(std::abs(e.power - expected.power) < 1e-13 * std::abs(expected.power));
}

BOOST_AUTO_TEST_CASE(rigid_motion_is_left_alone) { BOOST_TEST(friction(0.0).largest < 1e-15); }

BOOST_AUTO_TEST_CASE(promises_follow) {
    const auto plain = disk()->promises();
    const auto damped = DampedModel(disk(), friction_gamma).promises();
    BOOST_TEST((damped.angular_momentum == plain.angular_momentum));
    BOOST_TEST((damped.energy == Promise::not_kept));
    BOOST_TEST((damped.momentum == plain.momentum));
    BOOST_TEST((DampedModel(disk(), 0.0).promises().energy == plain.energy));
    const DampedModel all(disk(), friction_gamma, Friction::all_motion);
    BOOST_TEST((all.promises().momentum == Promise::not_kept));
    BOOST_TEST((all.promises().angular_momentum == Promise::not_kept));
    BOOST_TEST((all.promises().energy == Promise::not_kept));
    BOOST_TEST((all.describe().find("gamma = 0.3 of all motion") != std::string::npos));
    BOOST_CHECK_THROW(DampedModel(disk(), -0.1), InputError);
}

namespace {

/// A turning disk of smooth particles; shaken it is no rigid rotation, and the constraint works.
std::unique_ptr<SmoothParticleModel<2>> constrained(AngularMomentum law) {
    return std::make_unique<SmoothParticleModel<2>>(make_particles<2>(triangular_disk(4.0), 1.5),
                                                    ElasticSolid{0.7, 0.4},
                                                    Scheme{.angular_momentum = law, .range = 2.6});
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_model_inside_learns_of_its_bodies) {
    const auto plain = constrained(AngularMomentum::torque_pair);
    DampedModel damped(constrained(AngularMomentum::torque_pair), 0.0);
    const auto y = moving_state(*plain, 0.1);
    std::vector<double> with(y.size()), without(y.size());
    plain->rates(0.0, y, without);
    damped.rates(0.0, y, with);
    BOOST_TEST((with == without));
    std::vector<std::int32_t> halves;
    for (const auto& x : plain->particles().reference_position.colwise())
        halves.push_back(x.x() > 0.1 ? 1 : 0);
    const auto before = without;
    plain->set_bodies(halves);
    damped.set_bodies(halves);
    plain->rates(0.0, y, without);
    damped.rates(0.0, y, with);
    BOOST_TEST((without != before));
    BOOST_TEST((with == without));
    BOOST_TEST(damped.particles().body == halves, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(the_model_inside_is_remembered) {
    Archive written, inside;
    DampedModel damped(constrained(AngularMomentum::gauss), friction_gamma);
    const auto plain = constrained(AngularMomentum::gauss);
    damped.remember(written);
    plain->remember(inside);
    // The bodies of the wrapper, then all that the model knows.
    BOOST_TEST(written.bytes().size() > inside.bytes().size());
    BOOST_TEST(
        std::equal(inside.bytes().rbegin(), inside.bytes().rend(), written.bytes().rbegin()));
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
    const auto stress = model.stress(y, std::sqrt(0.75));
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

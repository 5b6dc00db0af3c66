// SPDX-License-Identifier: GPL-3.0-or-later
// Molecular dynamics with the weight function as potential: forces against every pair, the gradient
// of its energy, what it keeps.
#include "support/random_state.hpp"
#include <spam/core/error.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/rhs/density_potentials.hpp>
#include <spam/rhs/pair_potentials.hpp>

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

/// A law of pairs by its definition: energy and -(d phi/dr)/r by r, of a pair of these masses.
struct ByDefinition {
    std::function<double(double m_i, double m_j, double r)> energy, force_over_r;
};

/// The weight function as potential.
template <int Dim, class Weight>
ByDefinition of(const Weight& weight) {
    return {
        [=](double m_i, double m_j, double r) { return m_i * m_j * weight.value(r); },
        [=](double m_i, double m_j, double r) { return m_i * m_j * weight.minus_slope_over_r(r); }};
}
/// (2 - r^2)^8 - 2 (2 - r^2)^4 in units of its energy and of its spacing.
ByDefinition cohesive(double e_b, double a) {
    const auto inside = [=](double r) { return std::max(0.0, 2.0 - r * r / (a * a)); };
    return {[=](double, double, double r) {
                return e_b * (std::pow(inside(r), 8) - 2.0 * std::pow(inside(r), 4));
            },
            [=](double, double, double r) {
                return e_b * 2.0 / (a * a) *
                       (8.0 * std::pow(inside(r), 7) - 8.0 * std::pow(inside(r), 3));
            }};
}

/// s q_i q_j/sqrt(r^2 + eps^2) with q = m.
ByDefinition long_range(double s, double eps) {
    return {[=](double m_i, double m_j, double r) { return s * m_i * m_j / std::hypot(r, eps); },
            [=](double m_i, double m_j, double r) {
                return s * m_i * m_j / std::pow(std::hypot(r, eps), 3);
            }};
}

template <int Dim>
void every_pair(ParticleModel<Dim>& model, const ByDefinition& law) {
    const Box<Dim>& box = model.box();
    auto y = random_state(model, 82);
    const State<Dim> state(model.layout(), y);
    // Wherever the images are, on a grid on which a box's borders leave positions as they are.
    for (auto& x : state.position().reshaped()) x = std::round((x + 37.3) * 0x1p32) * 0x1p-32;
    const auto y_dot = rates_of(model, y);
    const auto x = state.position();
    const auto& m = model.particles().mass;
    const auto rate = ConstState<Dim>(model.layout(), y_dot);
    BOOST_TEST((rate.position() == state.velocity()));

    Points<Dim> v_dot = Points<Dim>::Zero(Dim, x.cols());
    Point<Dim> total = Point<Dim>::Zero();
    double energy = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        for (Eigen::Index j = 0; j < x.cols(); ++j) {
            if (i == j) continue;
            Point<Dim> r = x.col(j) - x.col(i);
            for (int a = 0; a < Dim; ++a)
                if (box.periodic(a)) r[a] -= box.length(a) * std::round(r[a] / box.length(a));
            const double m_i = m[static_cast<std::size_t>(i)], m_j = m[static_cast<std::size_t>(j)];
            v_dot.col(i) -= law.force_over_r(m_i, m_j, r.norm()) / m_i * r;
            energy += 0.5 * law.energy(m_i, m_j, r.norm());
        }
    BOOST_TEST((rate.velocity() - v_dot).norm() < 1e-13 * v_dot.norm());
    BOOST_TEST(std::abs(model.internal_energy(y) - energy) < 1e-13 * std::abs(energy));
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        total += m[static_cast<std::size_t>(i)] * rate.velocity().col(i);
    BOOST_TEST(total.norm() < 1e-13 * v_dot.norm());

    // dE/dt = sum m v . v_dot + d/dt of the potential, by a central difference
    const double h = 1e-5;
    auto later = y, earlier = y;
    State<Dim>(model.layout(), later).position() += h * state.velocity();
    State<Dim>(model.layout(), earlier).position() -= h * state.velocity();
    double power = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
        power +=
            m[static_cast<std::size_t>(i)] * state.velocity().col(i).dot(rate.velocity().col(i));
    const double change =
        (model.internal_energy(later) - model.internal_energy(earlier)) / (2.0 * h);
    BOOST_TEST(std::abs(change + power) < 1e-7 * (1.0 + std::abs(power)));
}

/// Both laws, of particles that are not on a lattice.
template <int Dim>
void every_pair(int cells, const Box<Dim>& box) {
    const auto particles = jittered_particles<Dim>(cells, 81, 0.15, box);
    PairPotentialModel<Dim> lucy(particles, 2.6, box);
    every_pair<Dim>(lucy, of<Dim>(Lucy<Dim>(2.6)));
    for (const Kernel kernel : {Kernel::w4, Kernel::monaghan}) {
        PairPotentialModel<Dim> other(particles, 2.6, box, kernel);
        every_pair<Dim>(other, of<Dim>(weight_function<Dim>(to_string(kernel), 2.6)));
    }
    ParticleModel<Dim> cohesion(particles, box);
    cohesion.template add_term<Cohesion<Dim>>(CohesivePotential{0.7, 1.1});
    every_pair<Dim>(cohesion, cohesive(0.7, 1.1));
    for (const auto& [strength, softening] : {std::pair(-0.8, 0.3), std::pair(1.7, 0.0)}) {
        const LongRangeScheme scheme{strength, softening};
        ParticleModel<Dim> attracted(particles, box);
        if (box.periodic()) {
            BOOST_CHECK_THROW(attracted.template add_term<LongRange<Dim>>(scheme), InputError);
            continue;
        }
        attracted.template add_term<LongRange<Dim>>(scheme);
        every_pair<Dim>(attracted, long_range(strength, softening));
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(on_the_line) {
    every_pair<1>(60, {});
    every_pair<1>(60, periodic<1>(60.0));
}
BOOST_AUTO_TEST_CASE(in_the_plane) {
    every_pair<2>(12, {});
    every_pair<2>(24, Box<2>({24.0, 24.0 * std::sqrt(0.75)}));
    every_pair<2>(12, Box<2>({12.0, 0.0}));
}
BOOST_AUTO_TEST_CASE(in_space) {
    every_pair<3>(6, {});
    every_pair<3>(7, periodic<3>(7.0));
}
BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    const auto particles = jittered_particles<2>(8, 83);
    BOOST_CHECK_THROW(PairPotentialModel<2>(particles, 0.9), InputError);
    BOOST_CHECK_THROW(PairPotentialModel<2>(particles, 4.1, Box<2>({0.8, 8.0})), InputError);
    ParticleModel<2> model(particles);
    for (const auto& wrong : {CohesivePotential{0.0, 1.0}, CohesivePotential{1.0, -1.0}})
        BOOST_CHECK_THROW(model.add_term<Cohesion<2>>(wrong), InputError);
}

// Charges of either sign; the list of all pairs lasts however far particles go.
BOOST_AUTO_TEST_CASE(charges) {
    auto particles = jittered_particles<3>(5, 84);
    LongRangeScheme scheme{2.0, 0.2, {}};
    for (std::size_t i = 0; i < particles.size(); ++i)
        scheme.charge.push_back(i % 3 == 0 ? -2.0 : 0.7);
    ParticleModel<3> charged(particles);
    auto& term = charged.add_term<LongRange<3>>(scheme);
    auto y = random_state(charged, 85);
    const State<3> state(charged.layout(), y);
    for (int turn = 0; turn < 3; ++turn) {
        const auto y_dot = rates_of(charged, y);
        const ConstState<3> rate(charged.layout(), y_dot);
        double energy = 0.0, worst = 0.0, largest = 0.0;
        Point<3> total = Point<3>::Zero(), torque = total;
        for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
            Point<3> force = Point<3>::Zero();
            for (Eigen::Index j = 0; j < state.position().cols(); ++j) {
                const Point<3> r = state.position().col(i) - state.position().col(j);
                const double q = 2.0 * scheme.charge[static_cast<std::size_t>(i)] *
                                 scheme.charge[static_cast<std::size_t>(j)];
                if (i == j) continue;
                force += q * std::pow(r.squaredNorm() + 0.04, -1.5) * r;
                energy += 0.5 * q / std::sqrt(r.squaredNorm() + 0.04);
            }
            const Point<3> found =
                particles.mass[static_cast<std::size_t>(i)] * rate.velocity().col(i);
            worst = std::max(worst, (found - force).norm());
            largest = std::max(largest, force.norm());
            total += found;
            torque += Point<3>(state.position().col(i)).cross(found);
        }
        BOOST_TEST(worst < 1e-13 * largest);
        BOOST_TEST(total.norm() < 1e-13 * largest);
        BOOST_TEST(torque.norm() < 1e-12 * largest * state.position().cwiseAbs().maxCoeff());
        BOOST_TEST(charged.internal_energy(y) == energy, boost::test_tools::tolerance(1e-13));
        state.position() *= 100.0;
    }
    BOOST_TEST(term.counts().list_builds == 1U);
    BOOST_TEST(term.counts().pairs == particles.size() * (particles.size() - 1) / 2);
}

// Softening where particles attract each other; charges that are one for each particle.
BOOST_AUTO_TEST_CASE(long_range_forces_that_make_no_sense) {
    ParticleModel<2> model(jittered_particles<2>(4, 86));
    std::vector<double> both(model.particles().size(), 1.0);
    both[3] = -1.0;
    for (const auto& wrong :
         {LongRangeScheme{0.0, 0.1}, LongRangeScheme{-1.0, 0.0}, LongRangeScheme{1.0, -0.1},
          LongRangeScheme{1.0, 0.0, both}, LongRangeScheme{1.0, 0.1, {1.0}}})
        BOOST_CHECK_THROW(model.add_term<LongRange<2>>(wrong), InputError);
    Box<2> box;
    box.set_wall(0, false, {WallKind::mirror, -5.0});
    ParticleModel<2> walled(jittered_particles<2>(4, 86), box);
    BOOST_CHECK_THROW(walled.add_term<LongRange<2>>(LongRangeScheme{}), InputError);
}

// What [HH07] 13 says of it, and what its comment does.
BOOST_AUTO_TEST_CASE(the_cohesive_potential) {
    const CohesivePotential phi;
    BOOST_TEST(phi.energy(1.0) == -1.0);
    BOOST_TEST(phi.force_over_r(1.0) == 0.0);
    BOOST_TEST(phi.energy(2.0) == 0.0);
    BOOST_TEST(phi.energy(3.0) == 0.0);
    const auto force = [&](double r) { return r * phi.force_over_r(r * r); };
    BOOST_TEST((force(0.999) - force(1.001)) / 0.002 == 128.0, boost::test_tools::tolerance(1e-3));
    double largest = 0.0, at = 0.0;
    for (double r = 1.0; r < phi.range(); r += 1e-4)
        if (-force(r) > largest) largest = -force(r), at = r;
    BOOST_TEST(largest == 5.30, boost::test_tools::tolerance(1e-3));
    BOOST_TEST(at == 1.098, boost::test_tools::tolerance(1e-3));
}

// Twice the masses in a law of twice the density: the same energies, pressures and forces.
BOOST_AUTO_TEST_CASE(what_neighbours_exchange_counts_masses_once) {
    const auto forces = [](double factor) {
        DensityPotentials p{.kernel = Kernel::w5, .range = 2.3};
        p.state = EmbeddedAtom{1.3, 0.9 * factor};
        auto particles = jittered_particles<2>(8, 98);
        for (double& m : particles.mass) m *= factor;
        const DensityPotentialModel<2> model(std::move(particles), p);
        return model.neighbour_forces(random_state(model, 99));
    };
    BOOST_TEST(forces(1.0) > 1.0);
    BOOST_TEST(forces(2.0) == forces(1.0), boost::test_tools::tolerance(1e-13));
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Fields of molecules: the bond function against closed forms, momentum that is balanced at every place, pairs that
// give the forces of the model, integrals over space that are totals.
#include "support/random_state.hpp"
#include <spam/core/error.hpp>
#include <spam/core/tensor.hpp>
#include <spam/diagnostics/field_grid.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/diagnostics/molecular_fields.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/kernel/monaghan_cubic.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/kernel/wn.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/artificial_viscosity.hpp>
#include <spam/rhs/contact.hpp>
#include <spam/rhs/pair_potentials.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <functional>
#include <random>

using namespace spam;
using namespace spam::test;

namespace {

constexpr double h = 1.7;

/// Integral of Lucy's w, by its powers of r, along a line at distance b from the centre, from its nearest place to s.
template <int Dim>
long double lucy_along(long double b, long double s) {
    s = std::clamp(s, -std::sqrt(std::max(0.0L, 1.0L - b * b)),
                   std::sqrt(std::max(0.0L, 1.0L - b * b)));
    const long double r = std::hypot(b, s), log = b > 0.0L ? std::asinh(s / b) : 0.0L;
    const long double r1 = (s * r + b * b * log) / 2.0L,
                      r3 = (s * r * r * r + 3.0L * b * b * r1) / 4.0L,
                      r2 = s * (b * b + s * s / 3.0L),
                      r4 = s * (b * b * b * b + 2.0L * b * b * s * s / 3.0L + s * s * s * s / 5.0L);
    return s - 6.0L * r2 + 8.0L * r3 - 3.0L * r4;
}

template <int Dim>
std::pair<Point<Dim>, Point<Dim>> random_line(std::mt19937_64& random, int n) {
    std::uniform_real_distribution<double> u(-1.3, 1.3);
    Point<Dim> a, b;
    for (int k = 0; k < Dim; ++k) a[k] = h * u(random), b[k] = h * u(random);
    if (n % 3 == 0) b = -0.4 * a;                                // through the centre
    if (n % 5 == 0) b = a + 0.02 * (b - a);                      // short
    if (n % 7 == 0) b = -0.7 * a + std::pow(10.0, -n % 11) * b;  // nearly through the centre
    return {a, b};
}

template <int Dim>
void check_bond_function() {
    std::mt19937_64 random(7);
    double worst = 0.0, worst_of_others = 0.0;
    for (int n = 1; n < 400; ++n) {
        const auto [a, b] = random_line<Dim>(random, n);
        const long double length = (b - a).norm();
        const Point<Dim> along = (b - a) / double(length);
        const Point<Dim> nearest = a - a.dot(along) * along;
        const long double away = Dim == 1 ? 0.0L : static_cast<long double>(nearest.norm()) / h;
        const long double exact =
            Lucy<Dim>(h).value(0.0) * h / length *
            (lucy_along<Dim>(away, b.dot(along) / h) - lucy_along<Dim>(away, a.dot(along) / h));
        const double w_0 = Lucy<Dim>(h).value(0.0);
        worst =
            std::max(worst, std::abs(mean_along<Dim>(Lucy<Dim>(h), a, b) - double(exact)) / w_0);
        for (const AnyWeight<Dim>& weight :
             {AnyWeight<Dim>(MonaghanCubic<Dim>(h)), AnyWeight<Dim>(Wn<Dim, 8>(h))}) {
            const int steps = 3000;
            double simpson = 0.0;
            for (int k = 0; k <= 2 * steps; ++k)
                simpson += (k == 0 || k == 2 * steps ? 1.0
                            : k % 2 == 1             ? 4.0
                                                     : 2.0) *
                           weight.value((a + 0.5 * k / steps * (b - a)).norm()) / (6.0 * steps);
            worst_of_others =
                std::max(worst_of_others,
                         std::abs(mean_along<Dim>(weight, a, b) - simpson) / weight.value(0.0));
        }
    }
    BOOST_TEST(worst < 1e-14);
    BOOST_TEST(worst_of_others < 1e-9);
    const Point<Dim> here = Point<Dim>::Constant(0.3);
    BOOST_TEST(mean_along<Dim>(Lucy<Dim>(h), here, here) == Lucy<Dim>(h).value(here.norm()));
}

/// A model of one law of pairs, or of two.
template <int Dim>
using Laws = std::vector<std::pair<const char*, std::function<void(ParticleModel<Dim>&)>>>;

template <int Dim>
Laws<Dim> laws(bool periodic) {
    Laws<Dim> all{
        {"cohesion",
         [](auto& m) {
             m.template add_term<Cohesion<Dim>>(CohesivePotential{0.7, 1.1});
         }},
        {"weight",
         [](auto& m) { m.template add_term<WeightPotential<Dim>>(1.9, 2.0, Kernel::w4); }},
        {"springs and a core",
         [](auto& m) {
             m.template add_term<Springs<Dim>>(HarmonicSpring{1.3, 0.9});
             m.template add_term<Core<Dim>>(CorePotential{2.0, 1.4});
         }},
        {"contact",
         [](auto& m) {
             m.template add_term<Contact<Dim>>(ContactScheme{0.3, 1.0, 1.3});
         }},
        {"cohesion of a part", [](auto& m) {
             m.template add_term_among<Cohesion<Dim>>(3, m.particles().size() - 5,
                                                      CohesivePotential{});
         }}};
    if (!periodic)
        all.push_back({"gravity", [](auto& m) {
                           m.template add_term<LongRange<Dim>>(LongRangeScheme{-0.4, 0.3});
                       }});
    return all;
}

/// d(rho u)/dt at one place, by accelerations.
template <int Dim>
Point<Dim> rate_of_momentum(const AnyWeight<Dim>& weight, ParticleModel<Dim>& model,
                            std::span<const double> y, const Point<Dim>& place) {
    const auto y_dot = rates_of(model, y);
    const ConstState<Dim> state(model.layout(), y), rate(model.layout(), y_dot);
    Point<Dim> sum = Point<Dim>::Zero();
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        const Point<Dim> s = model.box().separation(place, state.position().col(i));
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        sum += m * weight.value(s.norm()) * rate.velocity().col(i) +
               m * weight.minus_slope_over_r(s.norm()) * s.dot(state.velocity().col(i)) *
                   state.velocity().col(i);
    }
    return sum;
}

/// By differences, extrapolated.
template <int Dim>
Points<Dim> divergence(const MolecularFields<Dim>& fields, const Points<Dim>& places,
                       BondStress stress) {
    const double d = 1e-3;
    Points<Dim> sum = Points<Dim>::Zero(Dim, places.cols());
    for (int a = 0; a < Dim; ++a) {
        const auto at = [&](double s) {
            Points<Dim> moved = places;
            moved.row(a).array() += s;
            return fields.momentum_flux(moved, stress);
        };
        const Eigen::MatrixXd slope =
            (8.0 * (at(d) - at(-d)) - (at(2.0 * d) - at(-2.0 * d))) / (12.0 * d);
        for (int b = 0; b < Dim; ++b) sum.row(b) += slope.row(symmetric_index(Dim, a, b));
    }
    return sum;
}

template <int Dim>
void check_laws(int cells, const Box<Dim>& box) {
    const AnyWeight<Dim> weight = Wn<Dim, 6>(h);
    for (const auto& [name, add] : laws<Dim>(box.periodic()))
        BOOST_TEST_CONTEXT(Dim << "d, " << name) {
            auto particles = jittered_particles<Dim>(cells, 21, 0.1, box);
            for (std::size_t i = 0; i < particles.size(); ++i)
                particles.body[i] = i % 3 == 0 ? 1 : 0;
            ParticleModel<Dim> model(particles, box);
            add(model);
            auto y = random_state(model, 22);
            State<Dim>(model.layout(), y).position().array() += 0.3 * cells;  // across the border
            std::mt19937_64 random(23);
            std::normal_distribution<double> g;
            for (double& x : State<Dim>(model.layout(), y).position().reshaped())
                x += 0.02 * g(random);
            // One has folded onto another one of its body.
            auto x = State<Dim>(model.layout(), y).position();
            x.col(6) = x.col(60);
            x(0, 6) += 0.6;

            // Pairs give what the model finds.
            double energy = 0.0;
            Points<Dim> force = Points<Dim>::Zero(Dim, static_cast<Eigen::Index>(particles.size()));
            for (const auto& term : model.terms()) {
                const auto pairs = dynamic_cast<const ForcesOfPairs<Dim>&>(*term).pair_forces(y);
                for (const PairForce<Dim>& pair : *pairs) {
                    energy += pair.energy;
                    force.col(static_cast<Eigen::Index>(pair.i)) += pair.force_over_r * pair.r_ij;
                    force.col(static_cast<Eigen::Index>(pair.j)) -= pair.force_over_r * pair.r_ij;
                }
            }
            const auto y_dot = rates_of(model, y);
            Points<Dim> expected = ConstState<Dim>(model.layout(), y_dot).velocity();
            for (std::size_t i = 0; i < particles.size(); ++i)
                expected.col(static_cast<Eigen::Index>(i)) *= model.particles().mass[i];
            BOOST_TEST((force - expected).norm() < 1e-12 * expected.norm());
            BOOST_TEST(energy == model.internal_energy(y), boost::test_tools::tolerance(1e-10));
            BOOST_TEST(expected.norm() > 1e-3);

            const MolecularFields<Dim> fields(weight, model, y);
            Points<Dim> places(Dim, 12);
            for (Eigen::Index k = 0; k < places.cols(); ++k)
                places.col(k) = State<Dim>(model.layout(), y).position().col(7 * k + 3).array() +
                                0.3 * std::sin(1.0 + double(k));
            const Points<Dim> out = divergence(fields, places, BondStress::along_bonds),
                              halves = divergence(fields, places, BondStress::at_particles);
            Points<Dim> rate(Dim, places.cols());
            for (Eigen::Index k = 0; k < places.cols(); ++k)
                rate.col(k) = rate_of_momentum<Dim>(weight, model, y, places.col(k));
            BOOST_TEST((rate + out).norm() < 1e-7 * rate.norm());
            BOOST_TEST((rate + halves).norm() > 1e-3 * rate.norm());
        }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_bond_function) {
    check_bond_function<1>();
    check_bond_function<2>();
    check_bond_function<3>();
}
BOOST_AUTO_TEST_CASE(momentum_is_balanced_on_the_line) {
    check_laws<1>(90, {});
    check_laws<1>(90, Box<1>({90.0}));
}
BOOST_AUTO_TEST_CASE(momentum_is_balanced_in_the_plane) {
    check_laws<2>(10, {});
    check_laws<2>(10, Box<2>({10.0, 10.0 * std::sqrt(0.75)}));
}
BOOST_AUTO_TEST_CASE(momentum_is_balanced_in_space) {
    check_laws<3>(5, {});
    check_laws<3>(5, Box<3>({5.0, 5.0, 5.0}));
}

// Mass, momentum, energy and the virial of all, from a grid.
BOOST_AUTO_TEST_CASE(integrals_are_totals) {
    const Box<2> box({9.0, 9.0});
    ParticleModel<2> model(make_particles<2>(square_lattice<2>({9, 9}), 1.3, 1.0, box), box);
    model.add_term<Cohesion<2>>();
    auto y = random_state(model, 31);
    std::mt19937_64 random(32);
    std::normal_distribution<double> g;
    for (double& x : State<2>(model.layout(), y).position().reshaped()) x += 0.05 * g(random);
    const auto invariants = measure_invariants<2>(model, y);
    const auto grid = FieldGrid<2>::over(box, {72, 72});
    const MolecularFields<2> fields(Wn<2, 6>(2.0), model, y);
    for (const auto stress : {BondStress::along_bonds, BondStress::at_particles}) {
        const auto values = fields.at(grid.points(), stress);
        const double cell = 81.0 / static_cast<double>(grid.size());
        BOOST_TEST(values.density.sum() * cell == invariants.mass,
                   boost::test_tools::tolerance(1e-5));
        BOOST_TEST(values.energy.sum() * cell == invariants.energy,
                   boost::test_tools::tolerance(1e-5));
        const Point<2> momentum = values.velocity * values.density.transpose() * cell;
        BOOST_TEST((momentum - invariants.momentum).norm() < 1e-6 * invariants.mass);
        double virial = 2.0 * invariants.kinetic;
        const auto pairs = dynamic_cast<const ForcesOfPairs<2>&>(*model.terms()[0]).pair_forces(y);
        for (const auto& pair : *pairs) virial += pair.force_over_r * pair.r_ij.squaredNorm();
        const Eigen::MatrixXd flux = fields.momentum_flux(grid.points(), stress);
        BOOST_TEST((flux.row(0) + flux.row(1)).sum() * cell == virial,
                   boost::test_tools::tolerance(1e-5));
        // P + rho u u is the flux.
        for (Eigen::Index p = 0; p < 50; ++p) {
            const Point<2> u = values.velocity.col(p);
            BOOST_TEST(std::abs(values.pressure(2, p) + values.density(p) * u.x() * u.y() -
                                flux(2, p)) < 1e-12);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_rod_has_the_tension_of_its_spring) {
    Points<1> x(1, 2);
    x << 0.0, 1.0;
    ParticleModel<1> model(make_particles<1>(x, 1.0, 1.0));
    model.add_term<Springs<1>>(HarmonicSpring{2.0, 1.0});
    auto y = random_state(model, 41);
    State<1> state(model.layout(), y);
    state.position() << 0.0, 3.0;
    state.velocity() << 0.5, -0.5;
    const MolecularFields<1> fields(Lucy<1>(1.0), model, y);
    Points<1> at(1, 3);
    at << 1.5, 0.1, 7.0;
    const auto values = fields.at(at);
    BOOST_TEST(values.pressure(0, 0) == -4.0, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(values.velocity(0, 1) == 0.5, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(std::abs(values.temperature(1)) < 1e-14);  // of one particle
    BOOST_TEST(values.density(2) == 0.0);
    BOOST_TEST(std::isnan(values.velocity(0, 2)));
    BOOST_TEST(std::isnan(values.temperature(2)));
}

BOOST_AUTO_TEST_CASE(what_has_no_bonds_is_refused) {
    const auto refused = [](const Box<2>& box, double range, const auto& add) {
        ParticleModel<2> model(jittered_particles<2>(8, 51, 0.1, box), box);
        add(model);
        const auto y = random_state(model, 52);
        BOOST_CHECK_THROW(MolecularFields<2>(Lucy<2>(range), model, y), InputError);
    };
    const auto cohesion = [](auto& model) { model.template add_term<Cohesion<2>>(); };
    refused({}, 2.0, [](auto& model) {
        model.template add_term<SmoothParticles<2>>(ElasticSolid::triangular_lattice(), Scheme{});
    });
    refused({}, 2.0, [&](auto& model) {
        cohesion(model);
        model.template add_term<ArtificialViscosity<2>>(
            typename ArtificialViscosity<2>::Constants{0.1, 2.6, 1.0, 1.0, Kernel::lucy});
    });
    refused(Box<2>({8.0, 8.0 * std::sqrt(0.75)}), 4.1, cohesion);
    Box<2> walled;
    walled.set_wall(0, false, {WallKind::mirror, -5.0});
    refused(walled, 2.0, cohesion);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Shifting: the velocity that moves particles against sums over all pairs and images, in boxes and between
// walls; Fick's law on long waves; what it keeps, what it leaves alone, and where it is refused.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include "support/shifting_oracle.hpp"
#include <spam/core/parallel.hpp>
#include <spam/kernel/weight_integrals.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/material/embedded_atom.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

#include <numbers>

using namespace spam;
using namespace spam::test;
using namespace spam::test::shifting;

namespace {

Scheme shifted(Density density = Density::continuity, Kernel kernel = Kernel::w4) {
    return {.density = density,
            .transport = Transport::shifting,
            .shifting = 0.7,
            .kernel = kernel,
            .range = 3.0};
}

Fluid fluid(bool friction, bool by_pairs) {
    Fluid fluid{EmbeddedAtom{1.3, 1.1}};
    if (friction) fluid.viscosity = NewtonViscosity{0.1, 0.3};
    fluid.by_pairs = by_pairs;
    return fluid;
}

Points<2> shift(const ConstState<2>& state, const ConstState<2>& rate) {
    return rate.position() - state.velocity();
}

/// Largest difference from the sums, by the largest of them.
double off_by(const FluidModel<2>& model, std::span<const double> y, std::span<const double> y_dot,
              Mutation mutation = Mutation::none) {
    const ConstState<2> state(model.layout(), y), rate(model.layout(), y_dot);
    const Points<2> right = brute_force(model, state, mutation);
    return (shift(state, rate) - right).cwiseAbs().maxCoeff() / right.cwiseAbs().maxCoeff();
}

}  // namespace

BOOST_AUTO_TEST_CASE(velocities_are_those_of_sums_over_all_pairs_and_images) {
    for (const Box<2>& box : {periodic_box<2>(), channel(), cavity()})
        for (const auto density : {Density::continuity, Density::summed})
            for (const auto mean : {MeanDensityKind::arithmetic, MeanDensityKind::geometric})
                for (const Kernel kernel : {Kernel::lucy, Kernel::w4})
                    for (const int friction : {0, 1, 2}) {
                        Scheme scheme = shifted(density, kernel);
                        scheme.mean_density = mean;
                        FluidModel<2> model(disordered<2>(box, 3),
                                            fluid(friction > 0, friction == 2), scheme, box);
                        const auto y = random_state(model, 4);
                        const auto y_dot = rates_of(model, y);
                        BOOST_TEST_CONTEXT(model.describe()) {
                            BOOST_TEST(off_by(model, y, y_dot) < 1e-12);
                            BOOST_TEST(off_by(model, y, y_dot, Mutation::uphill) > 1.0);
                            BOOST_TEST(off_by(model, y, y_dot, Mutation::own_density) > 1e-3);
                            if (!box.periodic(1))
                                BOOST_TEST(off_by(model, y, y_dot, Mutation::no_images) > 0.1);
                        }
                    }
}

// Stress, friction, work and heat are those of the same particles that move with their own velocity.
BOOST_AUTO_TEST_CASE(nothing_else_changes) {
    for (const Box<2>& box : {periodic_box<2>(), channel()})
        for (const auto density : {Density::continuity, Density::summed})
            for (const int friction : {0, 1, 2})
                for (const double viscosity : {0.0, 0.3}) {
                    Scheme scheme = shifted(density);
                    scheme.viscosity = viscosity;
                    Scheme plain = scheme;
                    plain.transport = Transport::plain;
                    const Fluid matter = fluid(friction > 0, friction == 2);
                    FluidModel<2> model(disordered<2>(box, 5), matter, scheme, box),
                        without(disordered<2>(box, 5), matter, plain, box);
                    const auto y = random_state(model, 6);
                    const auto found = rates_of(model, y), expected = rates_of(without, y);
                    const ConstState<2> rate(model.layout(), found),
                        right(model.layout(), expected);
                    for (const Field field : {Field::velocity, Field::energy})
                        BOOST_TEST((rate.field(field) == right.field(field)), model.describe());
                }
}

// sum m rho changes as sum m_i m_j w_ij does while particles move with u; the continuity equation alone
// does not see that shifting parts them.
BOOST_AUTO_TEST_CASE(density_by_continuity_follows_the_count_of_particles) {
    const auto box = periodic_box<2>();
    for (const bool friction : {false, true})
        for (const Kernel kernel : {Kernel::lucy, Kernel::w4}) {
            FluidModel<2> model(disordered<2>(box, 21), fluid(friction, false),
                                shifted(Density::continuity, kernel), box);
            const auto y = random_state(model, 22);
            const auto y_dot = rates_of(model, y);
            const auto weight = weight_function<2>(to_string(kernel), model.scheme().range);
            const auto& mass = model.particles().mass;
            const auto counted = [&](double t) {
                const Points<2> x = ConstState<2>(model.layout(), y).position() +
                                    t * ConstState<2>(model.layout(), y_dot).position();
                double sum = 0.0;
                for_each_image(box, x, [&](Eigen::Index i, Eigen::Index j, const Point<2>& r) {
                    sum += mass[std::size_t(i)] * mass[std::size_t(j)] * weight.value(r.norm());
                });
                return sum;
            };
            constexpr double h = 1e-4;
            const double expected =
                (8.0 * (counted(h) - counted(-h)) - counted(2.0 * h) + counted(-2.0 * h)) /
                (12.0 * h);
            double found = 0.0, without = 0.0;
            const ConstState<2> state(model.layout(), y), rate(model.layout(), y_dot);
            for (Eigen::Index i = 0; i < rate.density().cols(); ++i)
                found += mass[std::size_t(i)] * rate.density()(0, i);
            for_each_image(box, state.position(),
                           [&](Eigen::Index i, Eigen::Index j, const Point<2>& r) {
                               without += mass[std::size_t(i)] * mass[std::size_t(j)] *
                                          weight.minus_slope_over_r(r.norm()) *
                                          r.dot(state.velocity().col(i) - state.velocity().col(j));
                           });
            BOOST_TEST(std::abs(found - expected) < 1e-7 * std::abs(expected));
            BOOST_TEST(std::abs(without - expected) > 0.01 * std::abs(expected));
        }
}

BOOST_AUTO_TEST_CASE(waves_of_displacements_decay_by_ficks_law) {
    constexpr int cells = 64;
    const double k = 2.0 * std::numbers::pi / cells, amplitude = 1e-3;
    const auto box = periodic_box<2>(cells);
    const auto particles = make_particles<2>(square_lattice<2>({cells, cells}), 1.0, 1.0, box);
    Scheme scheme = shifted(Density::continuity, Kernel::w5);
    scheme.range = 4.0;
    FluidModel<2> model(particles, Fluid{EmbeddedAtom{1.0, 1.0}}, scheme, box);
    auto y = model.state(particles.reference_position, Points<2>::Zero(2, cells * cells));
    const State<2> state(model.layout(), y);
    const double site = state.density()(0, 0);
    state.density().setOnes();
    state.position().row(0).array() +=
        amplitude * (k * particles.reference_position.row(0).array()).sin();
    const auto y_dot = rates_of(model, y);
    const ConstState<2> rate(model.layout(), y_dot);
    const double along =
        2.0 / (cells * cells) *
        (rate.position().row(0).array() * (k * particles.reference_position.row(0).array()).sin())
            .sum();
    // What the lattice makes of the wave, to the last digits, and of that Fick's law.
    const auto weight = weight_function<2>("w5", 4.0);
    const auto grad_x = [&](double dx, double dy) {
        return -weight.minus_slope_over_r(std::hypot(dx, dy)) * dx;
    };
    double lattice = 0.0;
    for (int dx = -4; dx <= 4; ++dx)
        for (int dy = -4; dy <= 4; ++dy)
            if (dx != 0 || dy != 0)
                lattice += (grad_x(dx + 1e-5, dy) - grad_x(dx - 1e-5, dy)) / 2e-5 *
                           (1.0 - std::cos(k * dx));
    const double D = 0.7 * 4.0 * model.fluid().state.sound_speed(site, 0.0);
    BOOST_TEST(std::abs(along / (-D * lattice * amplitude) - 1.0) < 1e-5);
    BOOST_TEST(std::abs(lattice / (k * k) - 1.0) < 0.05);
    BOOST_TEST(rate.position().row(1).cwiseAbs().maxCoeff() < 1e-9);
}

// What an explicit step must resolve. The term says it for many neighbours; few are stiffer.
BOOST_AUTO_TEST_CASE(the_fastest_decay_is_known) {
    const auto box = periodic_box<2>();
    for (const Kernel kernel : {Kernel::lucy, Kernel::w4, Kernel::w6})
        for (const double range : {2.6, 3.0, 4.0}) {
            Scheme scheme = shifted(Density::continuity, kernel);
            scheme.range = range;
            const auto particles = disordered<2>(box, 1, 0.0);
            FluidModel<2> model(particles, Fluid{EmbeddedAtom{1.0, 1.0}}, scheme, box);
            auto y = model.state(particles.reference_position, Points<2>::Zero(2, n * n));
            const State<2> state(model.layout(), y);
            state.density().setOnes();
            std::mt19937_64 random(7);
            std::normal_distribution<double> g;
            Points<2> d(2, n * n);
            for (auto& c : d.reshaped()) c = g(random);
            double fastest = 0.0;
            for (int turn = 0; turn < 60; ++turn) {  // power iteration
                d *= 1e-5 / d.norm();
                state.position() = particles.reference_position + d;
                const auto y_dot = rates_of(model, y);
                d = -ConstState<2>(model.layout(), y_dot).position();
                fastest = d.norm() / 1e-5;
            }
            BOOST_TEST_MESSAGE(to_string(kernel) << " " << range << ": " << fastest << " of "
                                                 << model.fastest_damping(y));
            BOOST_TEST(fastest < 1.6 * model.fastest_damping(y));
            BOOST_TEST(fastest > 0.9 * model.fastest_damping(y));
        }
}

BOOST_AUTO_TEST_CASE(momentum_and_energy_are_kept_and_the_centre_of_mass_moves_with_them) {
    for (const auto density : {Density::continuity, Density::summed})
        for (const int friction : {0, 1, 2}) {
            const auto box = periodic_box<2>();
            FluidModel<2> model(disordered<2>(box, 8), fluid(friction > 0, friction == 2),
                                shifted(density), box);
            const auto y = random_state(model, 9);
            const auto y_dot = rates_of(model, y);
            const ConstState<2> state(model.layout(), y), rate(model.layout(), y_dot);
            const Points<2> delta = shift(state, rate);
            Point<2> force = Point<2>::Zero(), shifts = force;
            double power = 0.0, orbital = 0.0, size = 0.0, moved = 0.0;
            for (Eigen::Index i = 0; i < delta.cols(); ++i) {
                const double m = model.particles().mass[static_cast<std::size_t>(i)];
                force += m * rate.velocity().col(i);
                shifts += m * delta.col(i);
                power +=
                    m * (rate.velocity().col(i).dot(state.velocity().col(i)) + rate.energy()(0, i));
                orbital += m * (delta(0, i) * state.velocity()(1, i) -
                                delta(1, i) * state.velocity()(0, i));
                size += m * rate.velocity().col(i).norm();
                moved += m * delta.col(i).norm();
            }
            BOOST_TEST(moved > 0.1);
            BOOST_TEST(force.norm() < 1e-13 * size);
            BOOST_TEST(shifts.norm() < 1e-13 * moved);
            BOOST_TEST(std::abs(power) < 1e-12 * size);
            BOOST_TEST(std::abs(orbital) > 1e-3 * moved);
            BOOST_TEST((model.promises().momentum == Promise::exact));
            BOOST_TEST((model.promises().energy == Promise::integrator_error));
            BOOST_TEST((model.promises().angular_momentum == Promise::not_kept));
        }
}

BOOST_AUTO_TEST_CASE(who_flies_by_sees_the_same) {
    const auto box = periodic_box<2>();
    FluidModel<2> model(disordered<2>(box, 10), fluid(true, true), shifted(), box);
    auto y = random_state(model, 11);
    const auto seen = rates_of(model, y);
    State<2>(model.layout(), y).velocity().colwise() += Point<2>(3.0, -2.0);
    auto flying = rates_of(model, y);
    State<2>(model.layout(), flying).position().colwise() -= Point<2>(3.0, -2.0);
    BOOST_TEST(relative_difference(flying, seen) < 1e-13);
}

BOOST_AUTO_TEST_CASE(threads_and_old_lists_change_no_bit) {
    Box<2> box({48.0, 48.0});
    Points<2> x = square_lattice<2>({48, 48});
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> u(-0.2, 0.2);
    for (auto& c : x.reshaped()) c += u(random);
    const auto particles = make_particles<2>(x, 1.0, 1.0, box);
    BOOST_TEST(particles.size() > parallel_threshold);
    std::vector<std::vector<double>> results;
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        FluidModel<2> model(particles, fluid(true, true), shifted(), box);
        auto y = random_state(model, 13);
        results.push_back(rates_of(model, y));
        for (auto& c : State<2>(model.layout(), y).position().reshaped()) c += 0.01;
        rates_of(model, y);  // by the same list
        for (auto& c : State<2>(model.layout(), y).position().reshaped()) c -= 0.01;
        BOOST_TEST(relative_difference(rates_of(model, y), results.front()) < 1e-12);
    }
    set_threads(1);
    BOOST_TEST((results[0] == results[1]));
    BOOST_TEST((results[0] == results[2]));
}

BOOST_AUTO_TEST_CASE(on_a_line_and_in_space) {
    const auto line = periodic_box<1>();
    FluidModel<1> row(disordered<1>(line, 14), fluid(true, true), shifted(), line);
    FluidModel<1> by_gradients(disordered<1>(line, 14), fluid(true, false), shifted(), line);
    const auto y = random_state(row, 15);
    const auto a = rates_of(row, y), b = rates_of(by_gradients, y);
    const auto moved = [&](const std::vector<double>& rates) -> Points<1> {
        return ConstState<1>(row.layout(), rates).position();
    };
    BOOST_TEST((moved(a) - moved(b)).norm() < 1e-13 * moved(a).norm());
    BOOST_TEST((moved(a) - ConstState<1>(row.layout(), y).velocity()).norm() > 0.1);
    const auto cube = periodic_box<3>();
    FluidModel<3> block(disordered<3>(cube, 16), fluid(true, true), shifted(), cube);
    const auto z = random_state(block, 17);
    const auto z_dot = rates_of(block, z);
    const ConstState<3> state(block.layout(), z), rate(block.layout(), z_dot);
    Point<3> shifts = Point<3>::Zero();
    for (Eigen::Index i = 0; i < state.position().cols(); ++i)
        shifts += block.particles().mass[static_cast<std::size_t>(i)] *
                  (rate.position() - state.velocity()).col(i);
    BOOST_TEST(shifts.norm() < 1e-11);
    BOOST_TEST((rate.position() - state.velocity()).norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(what_has_no_meaning_is_refused) {
    const auto box = periodic_box<2>();
    const auto why = [&](const Fluid& matter, const Scheme& scheme, const Box<2>& where) {
        return refusal([&] { FluidModel<2>(disordered<2>(where, 18), matter, scheme, where); });
    };
    const auto says = [](const std::string& text, const char* word) {
        BOOST_TEST((text.find(word) != std::string::npos), text);
    };
    const Fluid water = fluid(true, true);
    says(why(water, shifted(), box), "accepted");
    says(why(water, shifted(), channel()), "accepted");
    Box<2> open({double(n), 0.0});
    says(why(water, shifted(), open), "direction y");
    open.set_wall(1, false, {WallKind::mirror, 0.0});
    says(why(water, shifted(), open), "direction y");
    says(why(water, shifted(), periodic_box<2>(1.5 * n)), "fill 48 % of the box");
    says(why(Fluid{IdealGas{}}, shifted(), box), "sound speed");
    Scheme viscous = shifted();
    viscous.viscosity = 0.3;
    says(why(water, viscous, box), "accepted");
    says(why(fluid(true, false), viscous, box), "accepted");
    says(refusal([&] {
             SmoothParticleModel<2>(disordered<2>(box, 19), ElasticSolid{0.7, 0.4}, shifted(), box);
         }),
         "stress of a solid");
    auto two = disordered<2>(box, 20);
    two.material.assign(two.size(), 0);
    two.material[0] = 1;
    ParticleModel<2> mixed(two, box);
    const std::vector<Fluid> both{fluid(false, false), fluid(false, false)};
    says(refusal([&] { mixed.add_term<SmoothParticles<2>>(both, shifted()); }), "mix fluids");
}

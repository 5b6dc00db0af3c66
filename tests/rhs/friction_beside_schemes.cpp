// SPDX-License-Identifier: GPL-3.0-or-later
// Friction and conduction by pairs beside averaged velocities, artificial viscosity and the work of a particle's own
// stress, and between two fluids: sums over pairs by hand, and what is kept.
#include "support/random_state.hpp"
#include "support/refusal.hpp"
#include <spam/core/exact_sum.hpp>
#include <spam/kernel/any_weight.hpp>
#include <spam/material/ideal_gas.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

Fluid rubbing(int dim, double eta, double lambda, double kappa) {
    Fluid fluid{IdealGas{dim, 1.0}};
    if (eta > 0.0) fluid.viscosity = NewtonViscosity{lambda, eta};
    if (kappa > 0.0) fluid.conduction = FourierConduction{kappa};
    fluid.by_pairs = true;
    return fluid;
}
Fluid without(Fluid fluid) {
    fluid.viscosity.reset();
    fluid.conduction.reset();
    return fluid;
}
std::vector<Fluid> without(std::vector<Fluid> fluids) {
    for (Fluid& fluid : fluids) fluid = without(fluid);
    return fluids;
}

/// One fluid, or two whose particles lie among each other, or two one of which has neither.
template <int Dim>
std::vector<std::vector<Fluid>> mixtures() {
    const Fluid thin = rubbing(Dim, 0.7, 0.2, 0.9), thick = rubbing(Dim, 2.0, -0.5, 0.1);
    return {{thin}, {thin, thick}, {thick, without(thin)}};
}

template <int Dim>
struct Gas {
    ParticleModel<Dim> model;
    SmoothParticles<Dim>& law;

    Gas(Particles<Dim> particles, const std::vector<Fluid>& fluids, const Scheme& scheme,
        const Box<Dim>& box = {})
        : model(std::move(particles), box),
          law(model.template add_term<SmoothParticles<Dim>>(fluids, scheme)) {}
};

template <int Dim>
constexpr int cells = Dim == 1   ? 30
                      : Dim == 2 ? 9
                                 : 5;

/// Every third one is of the second of `fluids`.
template <int Dim>
Particles<Dim> mixed(std::size_t fluids, const Box<Dim>& box) {
    auto particles = jittered_particles<Dim>(cells<Dim>, 21, 0.15, box);
    if (fluids > 1)
        for (std::size_t i = 0; i < particles.size(); ++i)
            particles.material.push_back(i % 3 == 0 ? 1 : 0);
    return particles;
}

template <int Dim>
struct Rates {
    Points<Dim> v_dot;
    Eigen::RowVectorXd e_dot;
};

double harmonic_mean(double a, double b) { return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0; }
double arithmetic_mean(double a, double b) { return 0.5 * (a + b); }

/// What pairs give, by a loop over all of them with that `mean` of two fluids' eta, 2 eta + lambda and kappa.
template <int Dim>
Rates<Dim> by_hand(const Gas<Dim>& gas, const std::vector<Fluid>& fluids,
                   const std::vector<double>& y, double (*mean)(double, double)) {
    const auto& particles = gas.model.particles();
    const Scheme& scheme = gas.law.scheme();
    const ConstState<Dim> state(gas.model.layout(), y);
    const auto weight = weight_function<Dim>(to_string(scheme.kernel), scheme.range);
    const auto rho = gas.model.density(y), T = gas.law.temperature(y);
    const Eigen::Index n = state.position().cols();
    Rates<Dim> rates{Points<Dim>::Zero(Dim, n), Eigen::RowVectorXd::Zero(n)};
    const auto fluid = [&](std::size_t i) -> const Fluid& {
        return fluids[particles.material.empty() ? 0
                                                 : static_cast<std::size_t>(particles.material[i])];
    };
    const auto eta = [&](std::size_t i) {
        const auto& newton = fluid(i).viscosity;
        return newton ? newton->eta : 0.0;
    };
    const auto longitudinal = [&](std::size_t i) {
        const auto& newton = fluid(i).viscosity;
        return newton ? 2.0 * newton->eta + newton->lambda : 0.0;
    };
    const auto kappa = [&](std::size_t i) {
        return fluid(i).conduction ? fluid(i).conduction->kappa : 0.0;
    };
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            if (i == j) continue;
            const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
            Point<Dim> r = state.position().col(j) - state.position().col(i);
            for (int c = 0; c < Dim; ++c)
                if (gas.model.box().periodic(c))
                    r[c] -=
                        gas.model.box().length(c) * std::round(r[c] / gas.model.box().length(c));
            const Point<Dim> v = state.velocity().col(j) - state.velocity().col(i);
            const double F =
                particles.mass[l] * weight.minus_slope_over_r(r.norm()) / rho[k] / rho[l];
            const double M = mean(eta(k), eta(l)), L = mean(longitudinal(k), longitudinal(l));
            const Point<Dim> f =
                F * ((3.0 * M - L) * v + (Dim + 2) * (L - M) * r * (r.dot(v) / r.squaredNorm()));
            rates.v_dot.col(i) += f;
            rates.e_dot[i] += 0.5 * f.dot(v) + 2.0 * mean(kappa(k), kappa(l)) * F * (T[l] - T[k]);
        }
    return rates;
}

/// Largest difference of two rates, by the largest of the second.
template <class A>
double difference(const A& a, const A& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

std::vector<Scheme> schemes() {
    std::vector<Scheme> all;
    for (const Density density : {Density::continuity, Density::summed, Density::chain_rule})
        for (const auto transport : {Transport::plain, Transport::monaghan, Transport::average})
            for (const auto work : {Work::mean, Work::own})
                for (const double viscosity : {0.0, 1.0}) {
                    const bool plain = transport == Transport::plain;
                    if (plain ? density == Density::chain_rule : density == Density::summed)
                        continue;
                    all.push_back({.density = density,
                                   .transport = transport,
                                   .work = work,
                                   .viscosity = viscosity,
                                   .kernel = work == Work::own ? Kernel::w4 : Kernel::lucy,
                                   .range = 2.6});
                }
    return all;
}

template <int Dim>
void compare() {
    for (const bool closed : {false, true})
        for (const auto& fluids : mixtures<Dim>())
            for (const Scheme& scheme : schemes()) {
                const Box<Dim> box = closed ? periodic<Dim>(cells<Dim>) : Box<Dim>{};
                Gas<Dim> gas(mixed<Dim>(fluids.size(), box), fluids, scheme, box),
                    rest(mixed<Dim>(fluids.size(), box), without(fluids), scheme, box);
                auto y = random_state(gas.model, 22);
                const State<Dim> state(gas.model.layout(), y);
                for (auto& e : state.energy().reshaped()) e = std::abs(e) + 0.5;
                const auto all = rates_of(gas.model, y), others = rates_of(rest.model, y);
                BOOST_TEST_REQUIRE(gas.model.failure().empty(), gas.model.failure());
                const ConstState<Dim> a(gas.model.layout(), all), b(rest.model.layout(), others);
                const Rates<Dim> found{a.velocity() - b.velocity(), a.energy() - b.energy()};
                const auto expected = by_hand(gas, fluids, y, harmonic_mean);
                BOOST_TEST_CONTEXT(gas.model.describe() << (closed ? ", closed" : ", open")) {
                    BOOST_TEST(difference(found.v_dot, expected.v_dot) < 1e-11);
                    BOOST_TEST(difference(found.e_dot, expected.e_dot) < 1e-11);
                    BOOST_TEST((a.position() == b.position()));
                    if (a.has(Field::density)) BOOST_TEST((a.density() == b.density()));
                    if (fluids.size() > 1) {
                        const auto mutated = by_hand(gas, fluids, y, arithmetic_mean);
                        BOOST_TEST(difference(found.v_dot, mutated.v_dot) > 1e-2);
                        BOOST_TEST(difference(found.e_dot, mutated.e_dot) > 1e-2);
                    }
                    ExactSum energy;
                    std::array<ExactSum, Dim> force;
                    double size = 0.0;
                    for (Eigen::Index i = 0; i < a.velocity().cols(); ++i) {
                        const double m = gas.model.particles().mass[static_cast<std::size_t>(i)];
                        const Point<Dim> f = m * a.velocity().col(i);
                        const double heat = m * a.energy()(0, i),
                                     power = f.dot(state.velocity().col(i));
                        energy += heat;
                        energy += power;
                        for (int c = 0; c < Dim; ++c) force[static_cast<std::size_t>(c)] += f[c];
                        size += std::abs(heat) + std::abs(power) + f.norm();
                    }
                    BOOST_TEST(std::abs(energy) < 1e-13 * size);
                    for (const ExactSum& f : force) BOOST_TEST(std::abs(f) < 1e-13 * size);
                }
            }
}

}  // namespace

BOOST_AUTO_TEST_CASE(pairs_are_added_to_any_scheme_on_the_line) { compare<1>(); }
BOOST_AUTO_TEST_CASE(pairs_are_added_to_any_scheme_in_the_plane) { compare<2>(); }
BOOST_AUTO_TEST_CASE(pairs_are_added_to_any_scheme_in_space) { compare<3>(); }

BOOST_AUTO_TEST_CASE(one_fluid_by_two_names_is_one) {
    const Fluid fluid = rubbing(2, 0.7, 0.2, 0.9);
    const Scheme scheme{.density = Density::continuity, .range = 2.6};
    Gas<2> one(mixed<2>(1, {}), {fluid}, scheme), two(mixed<2>(2, {}), {fluid, fluid}, scheme);
    auto y = random_state(one.model, 5);
    const State<2> state(one.model.layout(), y);
    for (auto& e : state.energy().reshaped()) e = std::abs(e) + 0.5;
    BOOST_TEST(relative_difference(rates_of(two.model, y), rates_of(one.model, y)) < 1e-14);
    BOOST_TEST(two.model.fastest_damping(y) == one.model.fastest_damping(y));
}

BOOST_AUTO_TEST_CASE(central_friction_turns_nothing_with_balanced_torques_too) {
    const Scheme balanced{.density = Density::continuity,
                          .transport = Transport::monaghan,
                          .angular_momentum = AngularMomentum::torque_pair,
                          .range = 2.6};
    for (const double lambda : {0.7, 0.1}) {
        const std::vector<Fluid> fluids{rubbing(2, 0.7, lambda, 0.5)};
        const auto why = refusal([&] { Gas<2>(mixed<2>(1, {}), fluids, balanced); });
        if (lambda == 0.1) {
            BOOST_TEST(why.find("lambda = eta") != std::string::npos, why);
            continue;
        }
        BOOST_TEST(why == "accepted");
        Gas<2> gas(mixed<2>(1, {}), fluids, balanced);
        auto y = random_state(gas.model, 4);
        const State<2> state(gas.model.layout(), y);
        for (auto& e : state.energy().reshaped()) e = std::abs(e) + 0.5;
        const auto rates = rates_of(gas.model, y);
        const ConstState<2> rate(gas.model.layout(), rates);
        double turning = 0.0, size = 0.0;
        for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
            const double m = gas.model.particles().mass[static_cast<std::size_t>(i)];
            const auto cross = [](const auto& a, const auto& b) {
                return a[0] * b[1] - a[1] * b[0];
            };
            turning += m * (cross(state.position().col(i), rate.velocity().col(i)) +
                            cross(rate.position().col(i), state.velocity().col(i)));
            size += m * rate.velocity().col(i).norm() * state.position().col(i).norm();
        }
        BOOST_TEST(std::abs(turning) < 1e-12 * size);
        BOOST_TEST((gas.model.promises().angular_momentum == Promise::integrator_error));
    }
}

BOOST_AUTO_TEST_CASE(pairs_of_one_fluid_and_gradients_of_another_are_refused) {
    Fluid gradients = rubbing(2, 0.7, 0.2, 0.9);
    gradients.by_pairs = false;
    const Scheme scheme{.density = Density::continuity, .range = 2.6};
    const auto why = refusal([&] {
        Gas<2>(mixed<2>(2, {}), {gradients, rubbing(2, 0.7, 0.2, 0.9)}, scheme);
    });
    BOOST_TEST(why.find("by_pairs") != std::string::npos, why);
    BOOST_TEST(refusal([&] {
                   Gas<2>(mixed<2>(2, {}), {without(gradients), rubbing(2, 0.7, 0.2, 0.9)}, scheme);
               }) == "accepted");
}

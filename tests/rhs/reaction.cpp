// SPDX-License-Identifier: GPL-3.0-or-later
// A species that spreads and reacts: Fick's law by definition, what diffusion and heat keep, what is refused.
#include "support/random_state.hpp"
#include <spam/core/error.hpp>
#include <spam/diagnostics/invariants.hpp>
#include <spam/kernel/lucy.hpp>
#include <spam/material/gamma_gas.hpp>
#include <spam/problem/motion.hpp>
#include <spam/rhs/reaction.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;

namespace {

auto concentration(const auto& state) { return state.find(field_kind::concentration); }

template <int Dim>
std::vector<double> some_state(const ParticleModel<Dim>& model) {
    auto y = random_state(model, 31);
    const State<Dim> state(model.layout(), y);
    for (std::size_t i = 0; i < model.particles().size(); ++i)
        concentration(state)[i] = 0.5 + 0.4 * std::sin(1.3 * static_cast<double>(i));
    return y;
}

template <int Dim>
void by_definition(int cells) {
    const double h = 2.6, D = 0.7, r = 0.9, a = 0.2;
    ParticleModel<Dim> model(jittered_particles<Dim>(cells, 32));
    model.template add_term<Reaction<Dim>>(ReactionScheme{D, r, a, 0.0, Kernel::lucy, h});
    auto y = some_state(model);
    const State<Dim> state(model.layout(), y);
    const auto y_dot = rates_of(model, y);
    const Lucy<Dim> w(h);
    const auto x = state.position();
    const auto& m = model.particles().mass;
    const double* const c = concentration(state);
    const Eigen::Index n = x.cols();
    const auto at = [](Eigen::Index k) { return static_cast<std::size_t>(k); };
    // m_j grad_i w_ij, and i itself
    const auto slope = [&](Eigen::Index i, Eigen::Index j) -> Point<Dim> {
        const Point<Dim> r_ji = x.col(j) - x.col(i);
        return m[at(j)] * w.minus_slope_over_r(r_ji.norm()) * r_ji;
    };
    std::vector<double> rho(at(n), 0.0);
    Points<Dim> q = Points<Dim>::Zero(Dim, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            rho[at(i)] += m[at(j)] * w.value((x.col(i) - x.col(j)).norm());
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            if (i != j)
                q.col(i) -=
                    D / rho[at(i)] * (c[j] - c[i]) * 2.0 / (rho[at(i)] + rho[at(j)]) * slope(i, j);
    const double* const found = concentration(ConstState<Dim>(model.layout(), y_dot));
    double worst = 0.0, largest = 0.0, total = 0.0, reacted = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        double c_dot = r * c[i] * (1.0 - c[i]) * (c[i] - a);
        reacted += m[at(i)] * c_dot;
        for (Eigen::Index j = 0; j < n; ++j)
            if (i != j) c_dot -= (q.col(i) + q.col(j)).dot(slope(i, j));
        worst = std::max(worst, std::abs(found[i] - c_dot));
        largest = std::max(largest, std::abs(c_dot));
        total += m[at(i)] * found[i];
    }
    BOOST_TEST(largest > 0.1);
    BOOST_TEST(worst < 1e-13 * largest);
    BOOST_TEST(std::abs(total - reacted) < 1e-13 * static_cast<double>(n) * largest);
}

/// A gas in which something spreads for a while; returns the change of sum m c by sum m, and of the energy.
std::array<double, 2> changes(const ReactionScheme& scheme) {
    ParticleModel<2> model(jittered_particles<2>(14, 33));
    auto& gas = model.add_term<SmoothParticles<2>>(Fluid{GammaGas{1.4}},
                                                   Scheme{.density = Density::summed});
    model.add_term<Reaction<2>>(scheme);
    const auto random = some_state(model);
    const ConstState<2> state(model.layout(), random);
    auto y = gas.start(state.position(), state.velocity(), 1.0);
    std::copy_n(concentration(state), model.particles().size(),
                concentration(State<2>(model.layout(), y)));
    const auto mean = [&](std::span<const double> of) {
        double sum = 0.0, mass = 0.0;
        const double* const c = concentration(ConstState<2>(model.layout(), of));
        for (std::size_t i = 0; i < model.particles().size(); ++i) {
            sum += model.particles().mass[i] * c[i];
            mass += model.particles().mass[i];
        }
        return sum / mass;
    };
    const double before = mean(y), energy = measure_invariants<2>(model, y).energy_balance();
    Motion<2> motion(model, y, {.method = "rk4", .dt = 0.02});
    motion.advance_to(2.0);
    return {mean(motion.y()) - before,
            measure_invariants<2>(model, motion.y()).energy_balance() / energy - 1.0};
}

}  // namespace

BOOST_AUTO_TEST_CASE(rates_by_definition) {
    by_definition<1>(40);
    by_definition<2>(9);
    by_definition<3>(5);
}

BOOST_AUTO_TEST_CASE(diffusion_keeps_the_mass_of_each_species) {
    const auto [c, energy] = changes({.diffusivity = 0.5, .rate = 0.0});
    BOOST_TEST(std::abs(c) < 1e-13);
    BOOST_TEST(std::abs(energy) < 1e-8);
}

BOOST_AUTO_TEST_CASE(a_reaction_keeps_the_energy_with_its_heat) {
    const auto [c, energy] = changes({.diffusivity = 0.5, .heat = 2.0});
    BOOST_TEST(std::abs(c) > 1e-3);
    BOOST_TEST(std::abs(energy) < 1e-8);
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    ParticleModel<2> model(jittered_particles<2>(8, 34));
    for (const auto& wrong : {ReactionScheme{.diffusivity = -1.0}, ReactionScheme{.rate = -1.0},
                              ReactionScheme{.diffusivity = 0.0, .rate = 0.0},
                              ReactionScheme{.heat = 1.0}, ReactionScheme{.range = 0.5}})
        BOOST_CHECK_THROW(model.add_term<Reaction<2>>(wrong), InputError);
    // What has not reacted is no energy that a wall could account for.
    Box<2> box;
    box.set_wall(0, false, {WallKind::no_slip, -20.0});
    for (const double heat : {0.0, 1.0}) {
        ParticleModel<2> walled(jittered_particles<2>(8, 34), box);
        walled.add_term<SmoothParticles<2>>(Fluid{GammaGas{2.0}},
                                            Scheme{.density = Density::summed});
        const ReactionScheme scheme{.heat = heat};
        if (heat > 0.0)
            BOOST_CHECK_THROW(walled.add_term<Reaction<2>>(scheme), InputError);
        else
            walled.add_term<Reaction<2>>(scheme);
    }
}

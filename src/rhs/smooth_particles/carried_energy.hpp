// SPDX-License-Identifier: GPL-3.0-or-later
// For models whose particles carry their energies in y.
#pragma once

#include <spam/core/error.hpp>
#include <spam/core/exact_sum.hpp>
#include <spam/core/parts.hpp>
#include <spam/material/fluid.hpp>
#include <spam/rhs/term.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {

/// sum m e
template <int Dim>
double carried_energy(const Particles<Dim>& particles, const ConstState<Dim>& state) {
    const auto e = state.energy();
    return exact_sum(particles.size(), [&](std::size_t i) {
        return particles.mass[i] * e(0, static_cast<Eigen::Index>(i));
    });
}

/// sum m |e|
template <int Dim>
double carried_energies(const Particles<Dim>& particles, const ConstState<Dim>& state) {
    const auto e = state.energy();
    return exact_sum(particles.size(), [&](std::size_t i) {
        return particles.mass[i] * std::abs(e(0, static_cast<Eigen::Index>(i)));
    });
}

/// Where neither particles nor sound move: what particles have fallen at over their distance. 1 where nothing
/// pulls at them either.
template <int Dim>
double speed_of_fall(Model<Dim>& model, const std::vector<double>& y) {
    std::vector<double> y_dot(y.size());
    model.rates(0.0, y, y_dot);
    const auto v_dot = ConstState<Dim>(model.layout(), y_dot).velocity();
    const double a = Parts::here().most(v_dot.cols() > 0 ? v_dot.colwise().norm().maxCoeff() : 0.0);
    return a > 0.0 ? std::sqrt(a * model.particles().spacing) : 1.0;
}

/// start() makes the state of a whole model, of as many particles as there are.
template <int Dim>
void expect_start(const Term<Dim>& law, const Points<Dim>& position, const Points<Dim>& velocity) {
    const std::size_t n = law.among().particles().size();
    if (!law.among().whole())
        throw InputError(fmt::format(
            "start: '{}' acts among some of the particles only, and start() makes the state of all; write their "
            "fields into a state yourself",
            law.nature().description));
    if (static_cast<std::size_t>(position.cols()) != n ||
        static_cast<std::size_t>(velocity.cols()) != n)
        throw InputError(
            fmt::format("start: there are {} positions and {} velocities of {} particles",
                        position.cols(), velocity.cols(), n));
}

/// y of fluids at `position` with these velocities and densities `rho` (N), and the energies of
/// temperature T or the law's own, law_of(i); sets the scales of the layout. Throws InputError naming a
/// particle outside the law.
template <int Dim, class LawOf>
std::vector<double> fluid_start(Model<Dim>& model, const LawOf& law_of, const Points<Dim>& position,
                                const Points<Dim>& velocity, const std::vector<double>& rho,
                                double T) {
    std::vector<double> y(model.layout().size(), 0.0);
    const State<Dim> state(model.layout(), y);
    state.position() = position;
    state.velocity() = velocity;
    double fastest = 0.0, most = 0.0;
    for (std::size_t i = 0; i < rho.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        const AnyEquationOfState& law = law_of(i);
        const double e = law.starting_energy(rho[i], T);
        if (!std::isfinite(law.pressure(rho[i], e)))
            throw InputError(fmt::format(
                "equation of state: density {:.6g} and temperature {:g} of particle {} at the "
                "start are outside the law ({}); start thinner or warmer, or change its constants",
                rho[i], T, model.particles().id[i], law.describe()));
        state.energy()(0, k) = e;
        if (state.has(Field::density)) state.density()(0, k) = rho[i];
        fastest = std::max({fastest, velocity.col(k).norm(), law.sound_speed(rho[i], e)});
        most = std::max(most, std::abs(e));
    }
    Parts& parts = Parts::here();
    fastest = parts.most(fastest);
    most = parts.most(most);
    const double mean = exact_sum(rho.size(), [&](std::size_t i) { return rho[i]; }) /
                        static_cast<double>(parts.total(rho.size()));
    if (!(fastest > 0.0)) fastest = speed_of_fall(model, y);
    model.set_scales({model.particles().spacing, fastest, mean, mean * fastest * fastest});
    model.layout().set_scale(Field::energy, std::max(most, fastest * fastest));
    return y;
}

}  // namespace spam

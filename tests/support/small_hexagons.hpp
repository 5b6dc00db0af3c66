// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "model_ode.hpp"
#include <spam/integrate/methods.hpp>
#include <spam/material/elastic_solid.hpp>
#include <spam/rhs/smooth_particles.hpp>
#include <spam/rhs/springs.hpp>
#include <spam/setup/lattices.hpp>

#include <cmath>

namespace spam::test {

/// A hexagon of n rings, turning and shaken by `amplitude`.
inline std::unique_ptr<System> shaken(std::unique_ptr<Model<2>> model, double amplitude) {
    std::vector<double> y(model->layout().size());
    const State<2> state(model->layout(), y);
    state.position() = model->particles().reference_position;
    for (Eigen::Index i = 0; i < state.position().cols(); ++i) {
        const auto x = state.position().col(i);
        state.velocity()(0, i) = -0.05 * x.y() + amplitude * std::sin(1.3 * x.x());
        state.velocity()(1, i) = 0.05 * x.x() + amplitude * std::cos(0.9 * x.y());
    }
    if (state.has(Field::density)) state.density().setConstant(2.0 / std::sqrt(3.0));
    return std::make_unique<System>(std::move(model), std::move(y));
}

/// Smooth particles that move with the averaged velocity. The range lies between two distances of the
/// lattice: no pair comes into it or leaves it, and the right-hand side has all derivatives.
inline std::unique_ptr<System> smooth_hexagon(int n, double amplitude) {
    Scheme scheme;
    scheme.transport = Transport::average;
    scheme.range = 2.85;
    return shaken(
        std::make_unique<SmoothParticleModel<2>>(make_particles<2>(triangular_hexagon(n), 1.0),
                                                 ElasticSolid{0.43, 0.43}, scheme),
        amplitude);
}

/// Springs between neighbours: y = (x, v).
inline std::unique_ptr<System> bonded_hexagon(int n, double amplitude) {
    return shaken(std::make_unique<BondedModel<2>>(make_particles<2>(triangular_hexagon(n), 1.0),
                                                   HarmonicSpring{1.0, 1.0}),
                  amplitude);
}

/// The hexagon on which a method can be tried.
inline std::unique_ptr<System> hexagon_for(const IntegrationMethod& method, int n,
                                           double amplitude) {
    return method.separable ? bonded_hexagon(n, amplitude) : smooth_hexagon(n, amplitude);
}

}  // namespace spam::test

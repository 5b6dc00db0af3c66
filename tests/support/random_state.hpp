// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/model.hpp>
#include <spam/setup/lattices.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace spam::test {

template <int Dim>
Box<Dim> periodic(double length) {
    std::array<double, Dim> lengths;
    lengths.fill(length);
    return Box<Dim>(lengths);
}

/// A lattice of about `cells`^Dim particles with spacing 1, jittered, unequal masses: nothing about
/// it is symmetric. In 2D a block of the triangular lattice.
template <int Dim>
Particles<Dim> jittered_particles(int cells, unsigned seed, double jitter = 0.15,
                                  const Box<Dim>& box = {}) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    Points<Dim> points;
    if constexpr (Dim == 2) {
        points = triangular_block(cells, cells);
    } else {
        std::array<int, Dim> n;
        n.fill(cells);
        points = square_lattice<Dim>(n);
    }
    for (auto& x : points.reshaped()) x += jitter * u(random);
    auto particles = make_particles<Dim>(points, 1.0, 1.0, box);
    for (double& m : particles.mass) m = 1.0 + 0.2 * u(random);
    return particles;
}

/// A state with every field random: velocities of order 1, densities around one, stresses of both
/// signs.
template <int Dim>
std::vector<double> random_state(const Model<Dim>& model, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> g;
    std::vector<double> y(model.layout().size());
    const State<Dim> state(model.layout(), y);
    state.position() = model.particles().reference_position;
    for (auto& v : state.velocity().reshaped()) v = g(random);
    if (state.has(Field::density))
        for (auto& rho : state.density().reshaped()) rho = 1.1 + 0.1 * std::tanh(g(random));
    if (state.has(Field::stress))
        for (auto& s : state.stress().reshaped()) s = 0.3 * g(random);
    if (state.has(Field::energy))
        for (auto& e : state.energy().reshaped()) e = g(random);
    return y;
}

template <int Dim>
std::vector<double> rates_of(Model<Dim>& model, std::span<const double> y) {
    std::vector<double> y_dot(y.size());
    model.rates(0.0, y, y_dot);
    return y_dot;
}

/// Largest |a - b| relative to the largest |b|.
inline double relative_difference(std::span<const double> a, std::span<const double> b) {
    double difference = 0.0, size = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        difference = std::max(difference, std::abs(a[k] - b[k]));
        size = std::max(size, std::abs(b[k]));
        if (std::isnan(a[k]) || std::isnan(b[k])) return HUGE_VAL;
    }
    return size > 0.0 ? difference / size : difference;
}

/// Every scheme that makes sense in Dim dimensions.
template <int Dim>
std::vector<Scheme> all_schemes(Kernel kernel = Kernel::lucy) {
    std::vector<Scheme> schemes;
    for (const auto density : {Density::continuity, Density::summed, Density::chain_rule})
        for (const auto transport : {Transport::plain, Transport::average, Transport::monaghan})
            for (const auto mean : {MeanDensityKind::arithmetic, MeanDensityKind::geometric})
                for (const auto L :
                     {AngularMomentum::free, AngularMomentum::gauss,
                      AngularMomentum::torque_particle, AngularMomentum::torque_pair})
                    for (const double viscosity : {0.0, 0.3}) {
                        if (L != AngularMomentum::free && Dim == 1) continue;
                        if (density == Density::chain_rule && transport == Transport::plain)
                            continue;
                        schemes.push_back({.density = density,
                                           .transport = transport,
                                           .mean_density = mean,
                                           .angular_momentum = L,
                                           .viscosity = viscosity,
                                           .kernel = kernel,
                                           .range = 2.6});
                    }
    return schemes;
}

}  // namespace spam::test

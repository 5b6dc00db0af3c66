// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/sums.hpp>
#include <spam/diagnostics/invariants.hpp>

#include <array>

namespace spam {
namespace {

/// The two axes of each rotation plane: z in the plane; x, y, z in space.
template <int Dim>
constexpr std::array<int, 2> plane_axes(int plane) {
    if constexpr (Dim == 2) return {0, 1};
    return {(plane + 1) % 3, (plane + 2) % 3};
}

template <int Dim, class View>
double angular_momentum_term(const View& x, const View& v, Eigen::Index i, int plane) {
    const auto [a, b] = plane_axes<Dim>(plane);
    return x(a, i) * v(b, i) - x(b, i) * v(a, i);
}

}  // namespace

template <int Dim>
Invariants<Dim> measure_invariants(const Model<Dim>& model, std::span<const double> y) {
    const ConstState<Dim> state(model.layout(), y);
    const auto x = state.position();
    const auto v = state.velocity();
    CompensatedSum mass, kinetic;
    std::array<CompensatedSum, 3> momentum, angular;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const double m = model.particles().mass[static_cast<std::size_t>(i)];
        mass += m;
        for (int a = 0; a < Dim; ++a) {
            momentum[static_cast<std::size_t>(a)] += m * v(a, i);
            kinetic += 0.5 * m * v(a, i) * v(a, i);
        }
        for (int plane = 0; plane < Invariants<Dim>::planes; ++plane)
            angular[static_cast<std::size_t>(plane)] +=
                m * angular_momentum_term<Dim>(x, v, i, plane);
    }
    Invariants<Dim> result;
    result.mass = mass;
    for (int a = 0; a < Dim; ++a) result.momentum[a] = momentum[static_cast<std::size_t>(a)];
    for (int p = 0; p < Invariants<Dim>::planes; ++p)
        result.angular_momentum[p] = angular[static_cast<std::size_t>(p)];
    result.kinetic = kinetic;
    result.internal = model.internal_energy(y);
    result.energy = result.kinetic + result.internal;
    if (state.has(Field::work)) {
        result.work = state.field(Field::work)(0, 0);
        result.heat = state.field(Field::heat)(0, 0);
        result.impulse = state.field(Field::impulse);
        if constexpr (Dim > 1) result.angular_impulse = state.field(Field::angular_impulse);
    }
    result.work += model.gains().work;
    result.impulse += model.gains().impulse;
    result.angular_impulse += model.gains().angular_impulse;
    return result;
}

std::vector<double> angular_momentum_of_bodies(const Model<2>& model, std::span<const double> y) {
    const ConstState<2> state(model.layout(), y);
    const auto x = state.position();
    const auto v = state.velocity();
    std::vector<CompensatedSum> sums(static_cast<std::size_t>(model.particles().bodies()));
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        sums[static_cast<std::size_t>(model.particles().body[k])] +=
            model.particles().mass[k] * angular_momentum_term<2>(x, v, i, 0);
    }
    return {sums.begin(), sums.end()};
}

template <int Dim>
InvariantScales measure_scales(const Model<Dim>& model, std::span<const double> y) {
    const ConstState<Dim> state(model.layout(), y);
    const auto x = state.position();
    const auto v = state.velocity();
    InvariantScales scales;
    double distance = 0.0, speed = 0.0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const double x_i = x.col(i).norm(), v_i = v.col(i).norm();
        const double p = model.particles().mass[static_cast<std::size_t>(i)] * v_i;
        scales.momentum += p;
        scales.angular_momentum += p * x_i;
        distance += x_i;
        speed += v_i;
    }
    const auto n = static_cast<double>(x.cols());
    scales.force = model.neighbour_forces(y);
    scales.torque = scales.force * distance / n;
    scales.power = scales.force * speed / n;
    return scales;
}

template Invariants<1> measure_invariants(const Model<1>&, std::span<const double>);
template Invariants<2> measure_invariants(const Model<2>&, std::span<const double>);
template Invariants<3> measure_invariants(const Model<3>&, std::span<const double>);
template InvariantScales measure_scales(const Model<1>&, std::span<const double>);
template InvariantScales measure_scales(const Model<2>&, std::span<const double>);
template InvariantScales measure_scales(const Model<3>&, std::span<const double>);

}  // namespace spam

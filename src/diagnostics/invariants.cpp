// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/exact_sum.hpp>
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
    constexpr int planes = Invariants<Dim>::planes;
    const auto sums = exact_sums(model.particles().size(), [&](std::size_t k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double m = model.particles().mass[k];
        std::array<double, 2 + Dim + planes> terms{m, 0.5 * m * v.col(i).squaredNorm()};
        for (std::size_t a = 0; a < Dim; ++a) terms[2 + a] = m * v(static_cast<int>(a), i);
        for (std::size_t p = 0; p < planes; ++p)
            terms[2 + Dim + p] = m * angular_momentum_term<Dim>(x, v, i, static_cast<int>(p));
        return terms;
    });
    Invariants<Dim> result;
    result.mass = sums[0];
    result.kinetic = sums[1];
    result.momentum = Eigen::Map<const Point<Dim>>(&sums[2]);
    if constexpr (planes > 0)
        result.angular_momentum =
            Eigen::Map<const typename Invariants<Dim>::AngularMomentum>(&sums[2 + Dim]);
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

template <int Dim>
std::vector<double> angular_momentum_of_bodies(const Model<Dim>& model, std::span<const double> y) {
    const ConstState<Dim> state(model.layout(), y);
    const auto x = state.position();
    const auto v = state.velocity();
    constexpr std::size_t planes = Invariants<Dim>::planes;
    ExactGroupSums<planes> sums;
    const auto by_body =
        sums.of(model.particles().body, static_cast<std::size_t>(model.particles().bodies()),
                [&](std::size_t i) {
                    std::array<double, planes> L;
                    for (std::size_t p = 0; p < planes; ++p)
                        L[p] = model.particles().mass[i] *
                               angular_momentum_term<Dim>(x, v, static_cast<Eigen::Index>(i),
                                                          static_cast<int>(p));
                    return L;
                });
    std::vector<double> values;
    for (const auto& L : by_body) values.insert(values.end(), L.begin(), L.end());
    return values;
}
template std::vector<double> angular_momentum_of_bodies(const Model<2>&, std::span<const double>);
template std::vector<double> angular_momentum_of_bodies(const Model<3>&, std::span<const double>);

template <int Dim>
InvariantScales measure_scales(const Model<Dim>& model, std::span<const double> y) {
    const ConstState<Dim> state(model.layout(), y);
    const auto x = state.position();
    const auto v = state.velocity();
    const auto sums = exact_sums(model.particles().size(), [&](std::size_t k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double x_i = x.col(i).norm(), v_i = v.col(i).norm(),
                     p = model.particles().mass[k] * v_i;
        return std::array<double, 4>{p, p * x_i, x_i, v_i};
    });
    const auto [momentum, angular_momentum, distance, speed] = sums;
    const auto n = static_cast<double>(x.cols());
    const double force = model.neighbour_forces(y);
    return {momentum, angular_momentum, force, force * distance / n, force * speed / n};
}

#define SPAM_INSTANTIATE(D)                                                              \
    template Invariants<D> measure_invariants(const Model<D>&, std::span<const double>); \
    template InvariantScales measure_scales(const Model<D>&, std::span<const double>);
SPAM_IN_EACH_DIMENSION(SPAM_INSTANTIATE)

}  // namespace spam

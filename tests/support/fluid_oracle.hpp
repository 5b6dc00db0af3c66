// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/any_weight.hpp>
#include <spam/rhs/smooth_particles.hpp>

#include <cmath>
#include <cstdlib>

namespace spam::test {

/// One thing wrong in a fluid.
enum class FluidMutation {
    none,
    printed_work,     ///< [HH07] 4 prints e_dot with the sign that cools what is compressed
    work_not_shared,  ///< [HH01] eq 14 without its factor 1/2
    heat_of_one,      ///< only Q_i, not Q_j: what leaves one particle does not arrive at another
    partners_work,  ///< Work::own with the partner's stress: keeps the energy, and cools what is cold
    wrong_mass      ///< the particle's own mass in place of its partner's
};

/// The rates of FluidModel by loops over all pairs, straight from the formulas of FluidModel, in
/// numbers.
template <int Dim>
std::vector<double> fluid_rates(const FluidModel<Dim>& model, std::span<const double> y,
                                FluidMutation mutation = FluidMutation::none) {
    const Fluid& fluid = model.fluid();
    const Scheme& scheme = model.scheme();
    const auto weight = weight_function<Dim>(to_string(scheme.kernel), scheme.range);
    const ConstState<Dim> s(model.layout(), y);
    const auto& mass = model.particles().mass;
    const auto n = static_cast<Eigen::Index>(mass.size());
    const auto m = [&](Eigen::Index i) { return mass[static_cast<std::size_t>(i)]; };
    const auto separation = [&](Eigen::Index i, Eigen::Index j) {
        Point<Dim> r = s.position().col(i) - s.position().col(j);
        for (int a = 0; a < Dim; ++a)
            if (model.box().periodic(a))
                r[a] -= model.box().length(a) * std::round(r[a] / model.box().length(a));
        return r;
    };
    const auto grad_w = [&](const Point<Dim>& r) -> Point<Dim> {
        return -weight.minus_slope_over_r(r.norm()) * r;
    };
    using Tensor = Eigen::Matrix<double, Dim, Dim>;
    std::vector<double> rho(mass.size(), 0.0), T(mass.size(), 0.0);
    std::vector<Tensor> P(mass.size());
    std::vector<Point<Dim>> Q(mass.size());
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (s.has(Field::density))
            rho[k] = s.density()(0, i);
        else
            for (Eigen::Index j = 0; j < n; ++j)
                rho[k] += m(j) * weight.value(separation(i, j).norm());
        if (fluid.state.thermal) T[k] = fluid.state.temperature(rho[k], s.energy()(0, i));
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        Tensor grad_v = Tensor::Zero();
        Point<Dim> grad_T = Point<Dim>::Zero();
        for (Eigen::Index j = 0; j < n; ++j) {
            const auto l = static_cast<std::size_t>(j);
            const double mean = scheme.mean_density == MeanDensityKind::arithmetic
                                    ? 0.5 * (rho[k] + rho[l])
                                    : std::sqrt(rho[k] * rho[l]);
            const Point<Dim> g = grad_w(separation(i, j));
            const double divisor = scheme.work == Work::own ? rho[k] : mean;
            grad_v += m(j) / divisor * g * (s.velocity().col(j) - s.velocity().col(i)).transpose();
            grad_T += m(j) / mean * (T[l] - T[k]) * g;
        }
        P[k] = fluid.state.pressure(rho[k], s.energy()(0, i)) * Tensor::Identity();
        if (fluid.viscosity)
            P[k] -= fluid.viscosity->lambda * grad_v.trace() * Tensor::Identity() +
                    fluid.viscosity->eta * (grad_v + grad_v.transpose());
        Q[k] = fluid.conduction ? Point<Dim>(-fluid.conduction->kappa * grad_T)
                                : Point<Dim>(Point<Dim>::Zero());
    }
    std::vector<double> y_dot(y.size(), 0.0);
    const State<Dim> rate(model.layout(), y_dot);
    rate.position() = s.velocity();
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const auto k = static_cast<std::size_t>(i), l = static_cast<std::size_t>(j);
            const Point<Dim> g = grad_w(separation(i, j));
            const Point<Dim> v_ij = s.velocity().col(i) - s.velocity().col(j);
            const double rho_i = rho[k] * rho[k], rho_j = rho[l] * rho[l];
            const Point<Dim> f = (P[k] / rho_i + P[l] / rho_j) * g;
            const double m_j = mutation == FluidMutation::wrong_mass ? m(i) : m(j);
            rate.velocity().col(i) -= m_j * f;
            const double half = mutation == FluidMutation::printed_work      ? -0.5
                                : mutation == FluidMutation::work_not_shared ? 1.0
                                                                             : 0.5;
            const bool partners = mutation == FluidMutation::partners_work;
            const Point<Dim> shared =
                scheme.work == Work::mean
                    ? f
                    : Point<Dim>(2.0 * (partners ? P[l] / rho_j : P[k] / rho_i) * g);
            rate.energy()(0, i) += half * m_j * shared.dot(v_ij);
            const Point<Dim> q = mutation == FluidMutation::heat_of_one
                                     ? Point<Dim>(Q[k] / rho_i)
                                     : Point<Dim>(Q[k] / rho_i + Q[l] / rho_j);
            rate.energy()(0, i) -= m_j * q.dot(g);
            if (rate.has(Field::density)) rate.density()(0, i) += m_j * v_ij.dot(g);
        }
    return y_dot;
}

}  // namespace spam::test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "bar.hpp"

#include "../common.hpp"
#include <spam/material/hencky_solid.hpp>

namespace taylor_bar {
namespace {

constexpr double to_TPa = 1e-3, to_mm_per_us = 1e-3, to_g_per_mm3 = 1e-6;

/// Sites within the radius, about the axis; particles have the mass of the bar divided by their number, so
/// that the rim's steps do not change it.
Points<3> sites_of(const Parameters& p, double spacing, int layers) {
    std::vector<std::array<double, 2>> disk;
    const int reach = static_cast<int>(std::ceil(p.radius / spacing)) + 1;
    for (int i = -reach; i < reach; ++i)
        for (int j = -reach; j < reach; ++j) {
            const double x = (i + 0.5) * spacing, y = (j + 0.5) * spacing;
            if (x * x + y * y < p.radius * p.radius) disk.push_back({x, y});
        }
    Points<3> sites(3, static_cast<Eigen::Index>(disk.size()) * layers);
    Eigen::Index n = 0;
    for (int k = 0; k < layers; ++k)
        for (const auto& at : disk) sites.col(n++) << at[0], at[1], (k + 0.5) * spacing;
    return sites;
}

}  // namespace

double Parameters::time() const {
    const double v = speed * to_mm_per_us, rho = density * to_g_per_mm3;
    const double shorter = -length() * std::expm1(-0.5 * rho * v * v / (yield_stress * to_TPa));
    return (v > 0.0 ? 2.0 * shorter / v : 0.0) + 2.0 * length() / std::sqrt(young * to_TPa / rho);
}

Bar make_bar(const Parameters& p, int particles_per_radius) {
    const double nominal = p.radius / particles_per_radius;
    const int layers = static_cast<int>(std::lround(p.length() / nominal));
    const double spacing = p.length() / layers, rho = p.density * to_g_per_mm3;
    const double E = p.young * to_TPa;
    const double eta = 0.5 * E / (1.0 + p.poisson);
    const double lambda = E * p.poisson / ((1.0 + p.poisson) * (1.0 - 2.0 * p.poisson));
    auto particles =
        make_particles<3>(sites_of(p, spacing, layers), rho * std::pow(spacing, 3), spacing);
    Bar bar{{}, p.radius, spacing, layers};
    bar.model = std::make_shared<ParticleModel<3>>(std::move(particles));
    bar.wave_speed = std::sqrt((lambda + 2.0 * eta) / rho);
    if (p.compare) bar.call(fmt::format("r{}", particles_per_radius));
    const SpaceVonMises surface{lambda, eta};
    const LinearHardening flow{p.yield_stress * to_TPa, p.hardening * to_TPa};
    bar.law = &bar.model->add_term<TotalLagrangian<3>>(
        HenckySolid<SpaceVonMises>(surface, flow),
        TotalLagrangianScheme{rho, p.range * spacing, p.penalty});
    // As stiff as a layer of the solid half a spacing thick, which the wall stands for.
    bar.model->add(std::make_unique<RigidWall<3>>(Point<3>(0.0, 0.0, 1.0), 0.0,
                                                  0.1 * E * std::pow(spacing, 3), 0.5 * spacing));
    const double v = p.speed * to_mm_per_us;
    bar.y0 = initial_state<3>(*bar.model, rho, p.yield_stress * to_TPa,
                              [v](const Point<3>&) { return Point<3>(0.0, 0.0, -v); });
    return bar;
}

BarShape shape_of(const Bar& bar, std::span<const double> y) {
    const ConstState<3> state(bar.model->layout(), y);
    const auto F = bar.law->deformation_gradients(y);
    const auto& X = bar.model->particles().reference_position;
    const auto x = state.position();
    const double half = 0.5 * bar.spacing;
    const double outermost = X.topRows<2>().colwise().norm().maxCoeff();
    BarShape shape{0.0, 0.0, state.field(field_kind::plastic_strain).maxCoeff()};
    int of_rim = 0, of_end = 0;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const auto& f = F[static_cast<std::size_t>(i)];
        if (X(2, i) > (bar.layers - 1) * bar.spacing) {
            shape.length += x(2, i) + half * f(2, 2);
            ++of_end;
        }
        if (X(2, i) < bar.spacing && X.col(i).head<2>().norm() > outermost - 0.5 * half) {
            // The bar's surface is where the reference radius ends.
            const Point<2> out = X.col(i).head<2>().normalized();
            const Point<2> stretched(f(0, 0) * out.x() + f(0, 1) * out.y(),
                                     f(1, 0) * out.x() + f(1, 1) * out.y());
            shape.foot += x.col(i).head<2>().norm() +
                          (bar.radius - X.col(i).head<2>().norm()) * stretched.norm();
            ++of_rim;
        }
    }
    shape.length /= of_end;
    shape.foot /= of_rim;
    return shape;
}

Section section_of(const Bar& bar, std::span<const double> y) {
    const ConstState<3> state(bar.model->layout(), y);
    const auto& X = bar.model->particles().reference_position;
    std::vector<Eigen::Index> inside;
    for (Eigen::Index i = 0; i < X.cols(); ++i)
        if (X(1, i) > 0.0 && X(1, i) < bar.spacing) inside.push_back(i);
    Section section{Points<2>(2, static_cast<Eigen::Index>(inside.size())), {}};
    for (std::size_t k = 0; k < inside.size(); ++k) {
        const auto x = state.position().col(inside[k]);
        section.position.col(static_cast<Eigen::Index>(k)) << x[0], x[2];
        section.strain.push_back(state.field(field_kind::plastic_strain)(0, inside[k]));
    }
    return section;
}

}  // namespace taylor_bar

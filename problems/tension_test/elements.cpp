// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements.hpp"

#include <spam/core/error.hpp>
#include <spam/external/clamp.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/meshes.hpp>

#include <cmath>

namespace tension_elements {
namespace {

void drive_end(ParticleModel<2>& model, double side, double speed) {
    auto end = select<2>(model.particles(), [&](const Point<2>& x) {
        return side * x.x() > model.particles().reference_position.row(0).maxCoeff() - 1e-9;
    });
    const Point<2> velocity(side * speed, 0.0);
    auto clamp = std::make_unique<Clamp<2>>(
        std::move(end), [velocity](double) { return velocity; },
        [](double) { return Point<2>(0.0, 0.0); });
    clamp->only_along(0);
    model.add(std::move(clamp));
}

/// Heights of the columns of nodes, from left to right.
Eigen::ArrayXd heights(const Parameters& p, const Model<2>& model, std::span<const double> y) {
    const auto x = ConstState<2>(model.layout(), y).position();
    Eigen::ArrayXd top(p.columns + 1), bottom(p.columns + 1);
    for (std::size_t k = 0; k < model.particles().size(); ++k) {
        const auto id = static_cast<int>(model.particles().id[k]);
        const int column = id % (p.columns + 1), row = id / (p.columns + 1);
        if (row == 0) bottom[column] = x(1, static_cast<Eigen::Index>(k));
        if (row == p.rows) top[column] = x(1, static_cast<Eigen::Index>(k));
    }
    return top - bottom;
}

}  // namespace

Bar make_bar(const Parameters& p) {
    const auto elastic = ElasticSolid::triangular_lattice();
    const double density = std::sqrt(4.0 / 3.0), half = 0.5 * p.columns;
    Mesh mesh = rectangle_mesh(p.columns, p.rows);
    for (auto x : mesh.node.colwise()) x.y() *= 1.0 - p.taper * (1.0 - std::abs(x.x()) / half);
    MeshedBodies bodies = make_nodes({mesh}, density);
    Bar bar;
    bar.model = std::make_shared<ParticleModel<2>>(std::move(bodies.nodes));
    const YieldingSolid law(PlaneVonMises{elastic.lambda, elastic.eta},
                            LinearHardening{p.yield_stress, p.hardening},
                            Failure{.plastic_strain = p.failure_strain});
    bar.model->add_term<Elements>(std::move(bodies.element),
                                  std::vector<Elements::Material>{{law, density, p.hourglass}});
    for (const double side : {-1.0, 1.0}) drive_end(*bar.model, side, p.end_speed);
    bar.strain_rate = p.end_speed / half;
    bar.y0 = initial_state<2>(*bar.model, density, p.yield_stress, [&](const Point<2>& x) {
        return Point<2>(bar.strain_rate * x.x(), 0.0);
    });
    return bar;
}

Eigen::RowVectorXd plastic_strains(const Model<2>& model, std::span<const double> y) {
    return ConstState<2>(model.layout(), y).elements().field(field_kind::plastic_strain);
}

double neck(const Parameters& p, const Model<2>& model, std::span<const double> y) {
    Eigen::Index column = 0;
    heights(p, model, y).minCoeff(&column);
    return std::abs(static_cast<double>(column) - 0.5 * p.columns);
}

std::vector<Column<2>> columns_of(const Parameters& p) {
    using Y = std::span<const double>;
    return {{"largest_plastic_strain",
             [](const Model<2>& m, Y y) { return plastic_strains(m, y).maxCoeff(); }},
            {"mean_plastic_strain",
             [](const Model<2>& m, Y y) { return plastic_strains(m, y).mean(); }},
            {"neck", [p](const Model<2>& m, Y y) { return neck(p, m, y); }},
            {"neck_height", [p](const Model<2>& m, Y y) { return heights(p, m, y).minCoeff(); }},
            {"length",
             [](const Model<2>& m, Y y) {
                 const auto x = ConstState<2>(m.layout(), y).position().row(0);
                 return x.maxCoeff() - x.minCoeff();
             }},
            {"elements_broken",
             [](const Model<2>& m, Y y) { return static_cast<double>(elements_broken(m, y)); }}};
}

}  // namespace tension_elements

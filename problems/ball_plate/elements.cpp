// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements.hpp"

#include <spam/external/clamp.hpp>
#include <spam/material/yielding_solid.hpp>
#include <spam/setup/meshes.hpp>

namespace ball_plate_elements {
namespace {

/// Mean of a component of x or v over the nodes of a body, by mass.
template <class View>
double mean(const Particles<2>& nodes, std::int32_t body, const View& values) {
    double sum = 0.0, mass = 0.0;
    for (std::size_t k = 0; k < nodes.size(); ++k)
        if (nodes.body[k] == body) {
            sum += nodes.mass[k] * values(1, static_cast<Eigen::Index>(k));
            mass += nodes.mass[k];
        }
    return sum / mass;
}

}  // namespace

Impact make_impact(const Parameters& p) {
    const auto elastic = ElasticSolid::triangular_lattice();
    const double density = triangular_density;
    Mesh disk = disk_mesh(p.ball_side, p.radius);
    disk.node.row(1).array() += 0.5 * p.rows + p.gap + p.radius;
    MeshedBodies bodies = make_nodes({disk, rectangle_mesh(p.columns, p.rows)}, density);
    Impact impact;
    impact.model = std::make_shared<ParticleModel<2>>(std::move(bodies.nodes));
    ParticleModel<2>& model = *impact.model;
    const YieldingSolid law(PlaneVonMises{elastic.lambda, elastic.eta},
                            LinearHardening{p.yield_stress, p.hardening},
                            Failure{.plastic_strain = p.failure_strain});
    model.add_term<Elements>(std::move(bodies.element),
                             std::vector<Elements::Material>{{law, density, p.hourglass}});
    model.add_term<Contact<2>>(p.contact);
    const Particles<2>& nodes = model.particles();
    if (p.held)
        model.add(std::make_unique<Clamp<2>>(select<2>(nodes, [&](const Point<2>& x) {
            return std::abs(x.x()) > 0.5 * p.columns - 1e-9 && x.y() < 0.5 * p.rows + 0.5 * p.gap;
        })));
    impact.y0 = initial_state<2>(model, density, p.yield_stress, [&](const Point<2>& x) {
        return Point<2>(0.0, x.y() > 0.5 * (p.rows + p.gap) ? -p.speed : 0.0);
    });
    return impact;
}

double ball_speed(const Model<2>& model, std::span<const double> y) {
    return -mean(model.particles(), ball, ConstState<2>(model.layout(), y).velocity());
}

std::vector<Column<2>> columns_of() {
    using Y = std::span<const double>;
    return {{"ball_speed", ball_speed},
            {"elements_broken",
             [](const Model<2>& m, Y y) { return static_cast<double>(elements_broken(m, y)); }},
            {"largest_plastic_strain",
             [](const Model<2>& m, Y y) {
                 return ConstState<2>(m.layout(), y)
                     .elements()
                     .field(field_kind::plastic_strain)
                     .maxCoeff();
             }},
            {"sag", [](const Model<2>& m, Y y) {
                 return mean(m.particles(), plate, m.particles().reference_position) -
                        mean(m.particles(), plate, ConstState<2>(m.layout(), y).position());
             }}};
}

}  // namespace ball_plate_elements

// SPDX-License-Identifier: GPL-3.0-or-later
// The column as a mesh of elements.
#include "column.hpp"
#include <spam/external/clamp.hpp>
#include <spam/external/friction.hpp>
#include <spam/external/gravity.hpp>
#include <spam/setup/meshes.hpp>

#include <charconv>

namespace water_column {
namespace {

constexpr double at_wall = 1e-9;

/// "80x64"; as on the slide, dy = 2 dx = 1, where nothing is given.
std::array<int, 2> mesh_of(Parameters& p, const FluidColumn& column) {
    if (p.mesh.empty()) p.mesh = fmt::format("{}x{}", 2 * column.width, column.rows);
    std::array<int, 2> mesh{};
    const char *const begin = p.mesh.data(), *const end = begin + p.mesh.size();
    const auto across = std::from_chars(begin, end, mesh[0]);
    bool is_mesh = across.ec == std::errc() && across.ptr < end && *across.ptr == 'x';
    if (is_mesh) {
        const auto up = std::from_chars(across.ptr + 1, end, mesh[1]);
        is_mesh = up.ec == std::errc() && up.ptr == end;
    }
    const auto allowed = [](int n) { return n >= 1 && n <= 1000; };
    if (!is_mesh || !allowed(mesh[0]) || !allowed(mesh[1]))
        refuse(
            "mesh: '{}' is no mesh; give elements across and up, each 1 to 1000, as in --mesh "
            "80x64",
            p.mesh);
    return mesh;
}

/// Holds the nodes along x = 0 (and at x = `right`) across the walls, and those of the floor across it.
void add_guides(ParticleModel<2>& model, double right) {
    const auto guide = [&](int axis, double upper) {
        auto held = std::make_unique<Clamp<2>>(
            select<2>(model.particles(), [axis, upper](const Point<2>& x) {
                return x[axis] < at_wall || x[axis] > upper - at_wall;
            }));
        held->only_along(axis);
        model.add(std::move(held));
    };
    guide(0, right);
    guide(1, HUGE_VAL);
}

std::shared_ptr<ParticleModel<2>> model_of(const Parameters& p, const FluidColumn& column,
                                           const MeshedBodies& bodies, bool right_wall) {
    auto model = std::make_shared<ParticleModel<2>>(bodies.nodes);
    model->add_term<Elements>(
        bodies.element, std::vector<Elements::Material>{{Fluid{law_of(p)}, 1.0, p.hourglass}});
    model->add(std::make_unique<Gravity<2>>(Point<2>(0.0, -column.g)));
    if (right_wall)
        model->add(std::make_unique<Friction<2>>(column.damping, FrictionOf::all_motion));
    add_guides(*model, right_wall ? column.width : HUGE_VAL);
    model->layout().set_scale(Field::velocity, 0.1);
    return model;
}

}  // namespace

FluidColumn make_mesh_column(Parameters& p, bool only_described) {
    FluidColumn column = scaled_column(p, 1);
    column.mesh = mesh_of(p, column);
    // What is left of waves falls by half in a time 2 ln 2/gamma: pressures at rest are then exact to 1e-6.
    if (!p.relaxation_time) column.relaxation_time = 20.0 * column.width;
    Mesh mesh = rectangle_mesh(column.mesh[0], column.mesh[1]);
    const Point<2> side(static_cast<double>(column.width) / column.mesh[0],
                        static_cast<double>(column.rows) / column.mesh[1]);
    mesh.node.colwise() -= Point<2>(mesh.node.rowwise().minCoeff());
    mesh.node = side.asDiagonal() * mesh.node;
    const MeshedBodies bodies = make_nodes({mesh}, 1.0, side.minCoeff());
    column.between_walls = model_of(p, column, bodies, true);
    column.released = model_of(p, column, bodies, false);
    if (!only_described) {
        column.y0 = initial_state<2>(*column.between_walls, 1.0, 1.0, at_rest<2>());
        column.between_walls->layout().set_scale(Field::velocity, 0.1);
    }
    return column;
}

double step_of(const FluidColumn& column) {
    return 0.1 * std::min(static_cast<double>(column.width) / column.mesh[0],
                          static_cast<double>(column.rows) / column.mesh[1]);
}

std::vector<Slab> rows_of(const FluidColumn& column, std::span<const double> y) {
    const Model<2>& model = *column.between_walls;
    const auto x = ConstState<2>(model.layout(), y).position();
    const auto density = fluid_elements(model, y).density;
    const auto across = static_cast<std::size_t>(column.mesh[0]);
    std::vector<Slab> rows(static_cast<std::size_t>(column.mesh[1]));
    for (std::size_t k = 0; k < density.size(); ++k) {
        Slab& row = rows[k / across];
        for (const std::uint32_t corner : model.quadrilaterals()[k])
            row.y += 0.25 * x(1, corner) / column.mesh[0];
        row.density += density[k] / column.mesh[0];
    }
    return rows;
}

std::vector<Column<2>> mesh_columns(const Parameters& p) {
    using Y = std::span<const double>;
    const auto position = [](const Model<2>& model, Y y) {
        return ConstState<2>(model.layout(), y).position();
    };
    std::vector<Column<2>> columns{
        {"front", [=](const Model<2>& model, Y y) { return position(model, y).row(0).maxCoeff(); }},
        {"leading_percent",
         [=](const Model<2>& model, Y y) {
             const auto x = position(model, y);
             const auto& mass = model.particles().mass;
             std::vector<std::size_t> nodes(mass.size());
             std::iota(nodes.begin(), nodes.end(), std::size_t{0});
             std::sort(nodes.begin(), nodes.end(), [&](std::size_t a, std::size_t b) {
                 return x(0, static_cast<Eigen::Index>(a)) > x(0, static_cast<Eigen::Index>(b));
             });
             double left = 0.01 * std::accumulate(mass.begin(), mass.end(), 0.0);
             auto node = nodes.begin();
             while (node + 1 != nodes.end() && (left -= mass[*node]) > 0.0) ++node;
             return x(0, static_cast<Eigen::Index>(*node));
         }},
        {"height",
         [=](const Model<2>& model, Y y) {
             const auto x = position(model, y);
             double top = 0.0;
             for (Eigen::Index i = 0; i < x.cols(); ++i)
                 if (x(0, i) < at_wall) top = std::max(top, x(1, i));
             return top;
         }},
        {"hourglass_work", hourglass_work}};
    for (auto& one : compared_columns(p)) columns.push_back(std::move(one));
    return columns;
}

}  // namespace water_column

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/physics/quadrilateral.hpp>
#include <spam/setup/lattices.hpp>
#include <spam/setup/meshes.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {
namespace {

/// Every point of the square of half side r goes to the circle of radius r, along its ray from the centre.
Point<2> on_disk(const Point<2>& x) {
    const double r = x.cwiseAbs().maxCoeff();
    return r > 0.0 ? Point<2>(r / x.norm() * x) : x;
}

double area(const Points<2>& x, const Quadrilateral& corners, const Box<2>& box) {
    std::array<Vec<2>, 4> at;
    for (std::size_t c = 0; c < 4; ++c) {
        const Point<2> from_first = box.nearest(x.col(corners[c]) - x.col(corners[0]));
        at[c] = {{from_first[0], from_first[1]}};
    }
    return QuadrilateralShape<>(at).area;
}

}  // namespace

Mesh rectangle_mesh(int columns, int rows, double spacing, std::array<bool, 2> around) {
    if (columns < 1 || rows < 1 || !(spacing > 0.0))
        throw InputError(
            fmt::format("elements: {} x {} of side {:g} is no mesh; give at least 1 x 1", columns,
                        rows, spacing));
    Mesh mesh;
    const int across = columns + (around[0] ? 0 : 1), up = rows + (around[1] ? 0 : 1);
    mesh.node.resize(2, static_cast<Eigen::Index>(across) * up);
    const auto at = [&](int column, int row) {
        return static_cast<std::uint32_t>(row % up * across + column % across);
    };
    for (int row = 0; row < up; ++row)
        for (int column = 0; column < across; ++column)
            mesh.node.col(at(column, row)) =
                spacing * Point<2>(column - 0.5 * columns, row - 0.5 * rows);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            mesh.element.push_back({at(column, row), at(column + 1, row), at(column + 1, row + 1),
                                    at(column, row + 1)});
    return mesh;
}

Mesh disk_mesh(int n, double radius) {
    Mesh mesh = rectangle_mesh(n, n, 2.0 / std::max(n, 1));
    if (!(radius > 0.0))
        throw InputError(
            fmt::format("elements: the radius {:g} of a disk must be above 0", radius));
    for (Eigen::Index i = 0; i < mesh.node.cols(); ++i)
        mesh.node.col(i) = radius * on_disk(mesh.node.col(i));
    return mesh;
}

MeshedBodies make_nodes(const std::vector<Mesh>& bodies, double density, double spacing,
                        const Box<2>& box) {
    Eigen::Index nodes = 0;
    for (const Mesh& body : bodies) nodes += body.node.cols();
    Points<2> x(2, nodes);
    std::vector<double> mass(static_cast<std::size_t>(nodes), 0.0);
    std::vector<std::int32_t> body_of;
    MeshedBodies all;
    Eigen::Index first = 0;
    for (const Mesh& body : bodies) {
        x.middleCols(first, body.node.cols()) = body.node;
        body_of.resize(static_cast<std::size_t>(first + body.node.cols()),
                       static_cast<std::int32_t>(&body - bodies.data()));
        for (Quadrilateral corners : body.element) {
            const double quarter = 0.25 * density * area(body.node, corners, box);
            for (std::uint32_t& i : corners) {
                i += static_cast<std::uint32_t>(first);
                mass[i] += quarter;
            }
            all.element.push_back(corners);
        }
        first += body.node.cols();
    }
    all.nodes = make_particles<2>(x, 1.0, spacing);
    std::vector<std::uint32_t> stored(mass.size());
    for (std::size_t k = 0; k < stored.size(); ++k) {
        const auto id = static_cast<std::size_t>(all.nodes.id[k]);
        stored[id] = static_cast<std::uint32_t>(k);
        all.nodes.mass[k] = mass[id];
        all.nodes.body[k] = body_of[id];
    }
    for (Quadrilateral& corners : all.element)
        for (std::uint32_t& i : corners) i = stored[i];
    return all;
}

}  // namespace spam

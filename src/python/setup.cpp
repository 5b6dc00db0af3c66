// SPDX-License-Identifier: GPL-3.0-or-later
// Room setup: lattices.
#include "arrays.hpp"
#include "bindings.hpp"
#include <spam/core/error.hpp>
#include <spam/setup/lattices.hpp>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

namespace spam::python {
namespace {

constexpr double most_particles = 1e8;

void expect(bool holds, const char* option, double value, const char* allowed) {
    if (!holds)
        throw InputError(fmt::format("{}: {} is not allowed; use {}", option, value, allowed));
}

void expect_spacing(double spacing) {
    expect(std::isfinite(spacing) && spacing > 0.0, "spacing", spacing, "a positive number");
}

/// `particles`: in a cell.
template <class Cells>
void expect_cells(const Cells& cells, double spacing, double particles) {
    expect_spacing(spacing);
    for (const int n : cells) {
        expect(n >= 1, "cells", n, "1 or more in each direction");
        particles *= n;
    }
    expect(particles <= most_particles, "cells", particles, "up to 1e8 particles");
}

Doubles square(const std::vector<int>& cells, double spacing) {
    expect_cells(cells, spacing, 1.0);
    switch (cells.size()) {
        case 1:
            return array_of<1>(square_lattice<1>({cells[0]}, spacing));
        case 2:
            return array_of<2>(square_lattice<2>({cells[0], cells[1]}, spacing));
        case 3:
            return array_of<3>(square_lattice<3>({cells[0], cells[1], cells[2]}, spacing));
        default:
            throw InputError(
                fmt::format("cells: {} directions; give one, two or three", cells.size()));
    }
}

CubicLattice cubic_of(const std::string& name) {
    for (const auto& [lattice, known] : {std::pair{CubicLattice::sc, "sc"},
                                         {CubicLattice::fcc, "fcc"},
                                         {CubicLattice::bcc, "bcc"}})
        if (name == known) return lattice;
    throw InputError(
        fmt::format("lattice: '{}' is none of sc, fcc and bcc; give one of these", name));
}

/// `cut` of rows of three coordinates.
Doubles part_of(const py::handle& points, double radius,
                Points<3> (*cut)(const Points<3>&, double)) {
    expect(radius >= 0.0, "radius", radius, "0 or more");
    return array_of<3>(cut(points_of<3>(points, "points"), radius));
}

}  // namespace

void bind_setup(py::module_& module) {
    using namespace py::literals;
    module.def(
        "triangular_hexagon",
        [](int n, double spacing) {
            expect(n >= 0 && n <= 5000, "n", n, "0 to 5000");
            expect_spacing(spacing);
            return array_of<2>(triangular_hexagon(n, spacing));
        },
        "n"_a, "spacing"_a = 1.0,
        "Hexagon of triangular lattice, corners n spacings from the origin: (1 + 3n + 3n^2, 2).\n\n"
        "Raises InputError for n outside 0 to 5000.");
    module.def(
        "triangular_disk",
        [](double radius, double spacing) {
            expect_spacing(spacing);
            expect(radius >= 0.0 && radius <= 5000.0 * spacing, "radius", radius,
                   "0 to 5000 spacings");
            return array_of<2>(triangular_disk(radius, spacing));
        },
        "radius"_a, "spacing"_a = 1.0,
        "Sites of the triangular lattice not farther than `radius` from the one at the origin: (N, 2).");
    module.def(
        "triangular_block",
        [](int columns, int rows, double spacing) {
            expect_spacing(spacing);
            expect(columns >= 1, "columns", columns, "1 or more");
            expect(rows >= 1, "rows", rows, "1 or more");
            expect(1.0 * columns * rows <= most_particles, "columns", columns,
                   "up to 1e8 particles");
            return array_of<2>(triangular_block(columns, rows, spacing));
        },
        "columns"_a, "rows"_a, "spacing"_a = 1.0,
        "Rows of triangular lattice, the first particle at the origin: (columns rows, 2). Periodic in\n"
        "columns spacings and, for even rows, rows sqrt(3/4) spacings.");
    module.def(
        "square_lattice", &square, "cells"_a, "spacing"_a = 1.0,
        "Linear, square or cubic lattice of cells particles in each direction, [nx], [nx, ny] or\n"
        "[nx, ny, nz], the first at the origin: (N, D).");
    module.def(
        "cubic_lattice",
        [](const std::string& lattice, const std::array<int, 3>& cells, double spacing) {
            expect_cells(cells, spacing, 4.0);
            return array_of<3>(cubic_lattice(cubic_of(lattice), cells, spacing));
        },
        "lattice"_a, "cells"_a, "spacing"_a = 1.0,
        "Simple, face-centred or body-centred cubic lattice ('sc', 'fcc', 'bcc') of [nx, ny, nz] cells, nearest\n"
        "neighbours `spacing` apart, the first particle at the origin: (N, 3).");
    module.def(
        "ball_of",
        [](const py::handle& points, double radius) { return part_of(points, radius, &ball_of); },
        "points"_a, "radius"_a,
        "Of the points (N, 3) those not farther than `radius` from the origin: (M, 3).");
    module.def(
        "cylinder_of",
        [](const py::handle& points, double radius) {
            return part_of(points, radius, &cylinder_of);
        },
        "points"_a, "radius"_a,
        "Of the points (N, 3) those not farther than `radius` from the z axis: (M, 3).");
}

}  // namespace spam::python

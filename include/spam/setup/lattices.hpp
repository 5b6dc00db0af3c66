// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>
#include <spam/neighbors/box.hpp>

#include <cmath>

namespace spam {

/// Mass per area of a triangular lattice of mass and spacing 1: sqrt(4/3). A literal, because constants of other
/// files are made of it, which a compiler may initialise before the result of a function.
constexpr double triangular_density = 1.1547005383792515;
/// lambda = eta of its springs of constant 1 (ElasticSolid::triangular_lattice()): sqrt(3/16).
constexpr double triangular_modulus = 0.4330127018922193;

/// Regular hexagon of triangular lattice, nearest spacing `spacing`, centred on the origin, corners
/// n spacings away (one on the +x axis): 2 x (1 + 3n + 3n^2). [HHM04] VIII. n >= 0.
Points<2> triangular_hexagon(int n, double spacing = 1.0);

/// All sites of the triangular lattice not farther than `radius` from the one at the origin.
/// radius >= 0.
Points<2> triangular_disk(double radius, double spacing = 1.0);

/// Rows of triangular lattice: 2 x (columns rows), first particle at the origin; odd rows are
/// shifted by half a spacing. Periodic in columns * spacing and (rows even) rows * sqrt(3/4)
/// spacing.
Points<2> triangular_block(int columns, int rows, double spacing = 1.0);

/// The periodic box of that block. Throws InputError when the number of rows is odd.
Box<2> triangular_box(int columns, int rows, double spacing = 1.0);

/// Square (cubic, linear) lattice, `cells` particles in each direction, first one at the origin.
template <int Dim>
Points<Dim> square_lattice(const std::array<int, Dim>& cells, double spacing = 1.0);

/// Lattices whose cells are cubes: simple, face-centred, body-centred.
enum class CubicLattice { sc, fcc, bcc };
/// The edge of their cells where nearest neighbours are 1 apart: 1, sqrt(2), 2/sqrt(3).
double cubic_edge(CubicLattice lattice);
/// 1, 4 or 2 particles in each of so many cells, nearest neighbours `spacing` apart, the first one at the origin.
Points<3> cubic_lattice(CubicLattice lattice, const std::array<int, 3>& cells,
                        double spacing = 1.0);

/// Of the points those not farther than `radius` from the origin; in a cylinder: from the z axis.
Points<3> ball_of(const Points<3>& points, double radius);
Points<3> cylinder_of(const Points<3>& points, double radius);

/// The middles of so many squares (cubes, pieces of a line) of side 1 from the origin on.
template <int Dim>
Points<Dim> cell_centres(const std::array<int, Dim>& cells) {
    return square_lattice<Dim>(cells).array() + 0.5;
}

/// With their mean at the origin.
template <int Dim>
Points<Dim> centred(const Points<Dim>& position) {
    return position.colwise() - Point<Dim>(position.rowwise().mean());
}

/// Particles of equal mass at rest positions, put into strip order, with ids that remember the
/// order given and bodies found as parts connected within `reach` (1.5 spacings connects a
/// lattice).
template <int Dim>
Particles<Dim> make_particles(const Points<Dim>& position, double mass, double spacing = 1.0,
                              const Box<Dim>& box = {}, double reach = 0.0);

/// The same particles as one body, wherever they are.
template <int Dim>
Particles<Dim> one_body(Particles<Dim> particles) {
    particles.body.assign(particles.size(), 0);
    return particles;
}

/// Several bodies one after the other: ids and numbers of bodies of each go on behind those of the one
/// before, so that the particles of part k are those from the sum of the sizes before it on, and a term of
/// its own can be added among them. Throws InputError where spacings differ or some parts name materials
/// and others do not.
template <int Dim>
Particles<Dim> joined(const std::vector<Particles<Dim>>& parts);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/analysis/lattice_modes.hpp>
#include <spam/analysis/periodic_solid.hpp>
#include <spam/core/error.hpp>
#include <spam/setup/initial_state.hpp>
#include <spam/setup/lattices.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

/// Layers of this height that are just wider than twice the reach.
int least_layers(double reach, double height) { return static_cast<int>(2.0 * reach / height) + 1; }

/// `multiple`: of which the number of layers must be one; `what`: the lattice, in words.
void require_wide(double width, double range, double height, int multiple,
                  const std::string& what) {
    if (width > 2.0 * range) return;
    const int least = least_layers(range, height);
    throw InputError(
        fmt::format("cells: {} are too few for --range {}: a periodic lattice is "
                    "wider than twice the range; the least is {}",
                    what, range, least + least % multiple));
}

template <int Dim>
SolidLattice<Dim> lattice_at_rest(const Points<Dim>& points, const Box<Dim>& box,
                                  const Material<Dim>& material, const Scheme& scheme,
                                  double density, double stress) {
    SolidLattice<Dim> solid;
    solid.model = std::make_unique<SmoothParticleModel<Dim>>(
        make_particles<Dim>(points, 1.0, 1.0, box), material, scheme, box);
    solid.y0 = initial_state<Dim>(*solid.model, density, std::sqrt(3.0 / 16.0), at_rest<Dim>());
    const State<Dim> state(solid.model->layout(), solid.y0);
    state.stress().template topRows<Dim>().setConstant(stress);
    return solid;
}

}  // namespace

PeriodicSolid triangular_solid(int columns, int rows, const Material<2>& material,
                               const Scheme& scheme, double density, double stress) {
    if (!(scheme.range <= 1e4))
        throw InputError(fmt::format("range: {} must not be above 10000 spacings; 2 to 4 are usual",
                                     scheme.range));
    const Box<2> box = triangular_box(columns, rows);
    require_wide(std::min(box.length(0), box.length(1)), scheme.range, std::sqrt(0.75), 2,
                 fmt::format("{} x {} particles", columns, rows));
    return lattice_at_rest<2>(triangular_block(columns, rows), box, material, scheme, density,
                              stress);
}

PeriodicSolid smallest_triangular_solid(const Material<2>& material, const Scheme& scheme,
                                        double density, double stress) {
    if (!(scheme.range <= 30.0))
        throw InputError(
            fmt::format("range: {} must not be above 30 spacings: the lattice analysed is as wide "
                        "as all that a particle feels; 2 to 4 are usual",
                        scheme.range));
    const int cells = least_layers(coupling_reach(scheme), std::sqrt(0.75));
    const int even = std::max(4, cells + cells % 2);
    return triangular_solid(even, even, material, scheme, density, stress);
}

SolidLattice<3> cubic_solid(CubicLattice lattice, const std::array<int, 3>& cells,
                            const Material<3>& material, const Scheme& scheme, double stress) {
    if (!(scheme.range <= 6.0))
        throw InputError(fmt::format(
            "range: {} is above 6 spacings, too many neighbours in space; 2 to 4 are usual",
            scheme.range));
    const double edge = cubic_edge(lattice);
    const int least = *std::min_element(cells.begin(), cells.end());
    require_wide(least * edge, scheme.range, edge, 1, fmt::format("{} in a row", least));
    const Box<3> box({cells[0] * edge, cells[1] * edge, cells[2] * edge});
    const Points<3> points = cubic_lattice(lattice, cells);
    const double volume = box.length(0) * box.length(1) * box.length(2);
    return lattice_at_rest<3>(points, box, material, scheme,
                              static_cast<double>(points.cols()) / volume, stress);
}

SolidLattice<3> smallest_cubic_solid(CubicLattice lattice, const Material<3>& material,
                                     const Scheme& scheme, double stress) {
    // Whatever is not a range is refused before it becomes a number of cells.
    const double reach = scheme.range <= 6.0 ? coupling_reach(scheme) : 0.0;
    const int cells = std::max(3, least_layers(reach, cubic_edge(lattice)));
    return cubic_solid(lattice, {cells, cells, cells}, material, scheme, stress);
}

}  // namespace spam

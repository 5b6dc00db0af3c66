// SPDX-License-Identifier: GPL-3.0-or-later
// Liquid and vapour in a periodic box: how large their domains are, and how dense they are.
#pragma once

#include "../common.hpp"
#include <spam/diagnostics/field_grid.hpp>

namespace phase_separation {

using namespace spam;

/// Length of the lines on which a field on a periodic grid (FieldGrid::over) is `level`: straight in the two triangles
/// that a diagonal makes of every cell.
double contour_length(const FieldGrid<2>& grid, std::span<const double> values, double level);

/// The density of particles of mass 1 on a grid whose nodes are at most 1 apart.
struct DensityField {
    FieldGrid<2> grid;
    std::vector<double> values;

    DensityField(const AnyWeight<2>& weight, const Points<2>& position, const Box<2>& box);

    /// Area by length of the boundary between densities above and below `level`; infinite where there is none.
    double domain_size(double level) const;
    /// 2 pi/<k>: <k> is the mean wave number, weighted by the square of the waves' amplitude.
    double mean_wavelength() const;
    /// Mean of the liquid (above `level`) or the vapour, farther than `distance` from the other one; NaN where that is
    /// nowhere.
    double phase_density(double level, bool liquid, double distance) const;
};

}  // namespace phase_separation

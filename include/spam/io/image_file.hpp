// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/field_grid.hpp>
#include <spam/io/run_folder.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// A field on the nodes of a grid: components x nodes. As many components as dimensions is a vector and
/// written with three of them; any other number is written as it is.
struct ImageField {
    std::string name;
    Eigen::MatrixXd values;
};

/// Fields on a regular grid at time t for ParaView: NAME.vti, image data with point arrays (raw
/// appended, in the byte order of the machine) and field data TimeValue, box_low, box_high, periodic
/// (3 each), the box being as large as the grid where it is free. A plane is one node thick. Throws InputError when
/// a field has not one column a node, OutputError when it cannot be written.
template <int Dim>
void write_image(const RunFolder& folder, std::string_view name, double t, const Box<Dim>& box,
                 const FieldGrid<Dim>& grid, const std::vector<ImageField>& fields);

}  // namespace spam

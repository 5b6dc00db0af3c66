// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/state.hpp>
#include <spam/io/run_folder.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// One curve: rows of (x, y); empty cells are left out.
struct Curve {
    std::string title;
    std::vector<double> x, y;
    int like = 0;  ///< above 0: dashed, in the colour of the like-th curve that is not
};

/// A histogram as a curve: bars of one width around their centres.
Curve steps(std::string title, const std::vector<double>& centre, const std::vector<double>& height,
            double width);

/// A place on an axis that has a name.
struct Tick {
    double at;
    std::string label;
};

/// One frame of a row of curves.
struct CurvePanel {
    std::string title;  ///< above the frame
    std::string x_label, y_label;
    bool log_y = false;  ///< absolute values, zeros dropped
    std::vector<Curve> curves;
    std::vector<Tick> x_ticks{};  ///< in place of numbers
};

/// One frame of a grid of configurations: particles coloured by a value, and outlines.
struct ConfigurationPanel {
    std::string title;
    Points<2> position;
    std::vector<double> colour;
    std::vector<Points<2>> outlines;  ///< closed polygons
};

/// Pictures through gnuplot: <folder>/<name>.gp and <name>.dat are always written, <name>.png is
/// drawn when gnuplot is installed. Returns false when it could not be drawn.
/// Throws OutputError when script or data cannot be written.
bool draw_curves(const RunFolder& folder, std::string_view name, std::string_view title,
                 const std::vector<CurvePanel>& panels);

/// `columns` frames in a row, all with the same scale and the same colour range.
bool draw_configurations(const RunFolder& folder, std::string_view name, std::string_view title,
                         const std::vector<ConfigurationPanel>& panels, std::size_t columns,
                         std::string_view colour_label);

}  // namespace spam

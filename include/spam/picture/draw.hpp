// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/particles.hpp>
#include <spam/diagnostics/field_grid.hpp>
#include <spam/io/run_folder.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// Pictures through gnuplot: FOLDER/NAME.gp and NAME.dat are always written, NAME.png is
/// drawn when gnuplot is installed. All return false when it could not be drawn and throw
/// OutputError when script or data cannot be written.

enum class Mark { line, points };

/// One curve, or one cloud of points: rows of (x, y); what is not finite is left out.
struct Curve {
    std::string title;
    std::vector<double> x, y;
    Mark mark = Mark::line;
    int style = 0;  ///< colour 1 to 6; 0: its place among the curves that are not like another
    int like = 0;   ///< above 0: dashed, in the colour of the like-th curve that is not, no key
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

/// `columns` frames in a row; 0: all of them.
bool draw_curves(const RunFolder& folder, std::string_view name, std::string_view title,
                 const std::vector<CurvePanel>& panels, std::size_t columns = 0);

/// One curve between logarithmic axes; what is not above 0 is left out. `key`: its entry of the
/// picture's key, that is colour and mark (10 of them). Open: dashed, with open marks.
struct LogLogCurve {
    std::size_t key = 0;
    bool open = false;
    std::vector<double> x, y;
};

struct LogLogPanel {
    std::string title, x_label, y_label;
    std::vector<LogLogCurve> curves;
    double floor = 0.0;   ///< above 0: a line across, below which nothing is known
    std::string words{};  ///< in the frame's corner
};

/// Frames in rows of `columns`, one key for all of them under the last row.
struct LogLogPicture {
    std::string title;
    std::vector<LogLogPanel> panels;
    std::size_t columns = 2;
    std::vector<std::string> key;
    std::string note;   ///< a line under the key
    bool marks = true;  ///< at every point; else lines alone
};

bool draw_log_log(const RunFolder& folder, std::string_view name, const LogLogPicture& picture);

/// One frame of a grid of configurations: particles coloured by a value, and outlines. Or elements, in place of
/// particles: `colour` then belongs to them, and `position` to their nodes.
struct ConfigurationPanel {
    std::string title;
    Points<2> position;
    std::vector<double> colour;
    std::vector<Points<2>> outlines;        ///< closed polygons
    std::vector<Quadrilateral> elements{};  ///< by places in `position`
    /// Of particles that hide each other, the last ones in front, each with a rim; 0: as wide as there is room.
    double diameter = 0.0;
};

enum class ColourScale {
    dark_to_light,
    about_zero  ///< negative values in warm colours, positive ones in cold colours
};

/// `columns` frames in a row, all with the same scale and the same colour range.
bool draw_configurations(const RunFolder& folder, std::string_view name, std::string_view title,
                         const std::vector<ConfigurationPanel>& panels, std::size_t columns,
                         std::string_view colour_label,
                         ColourScale scale = ColourScale::dark_to_light);

/// One frame of a row: a field on a grid, or particles where it has no values.
struct ContourPanel {
    std::string title;             ///< above the frame
    std::string side{};            ///< beside it, upwards
    FieldGrid<2> grid{};           ///< nodes of the field
    std::vector<double> values{};  ///< one a node
    bool periodic = true;          ///< the field goes on beyond the last nodes
    Points<2> particles{};         ///< each drawn `dot` wide
    double dot = 0.7;
    double level = 0.0;  ///< in two tones: white above, black below
    struct Colours {
        double low, high;
        std::string label;
    };
    std::optional<Colours> colours{};  ///< in place of tones, with a key below the frame
};

/// The part of the plane that every frame shows.
struct ContourRoom {
    Point<2> low, high;
};

/// Frames in rows of `columns`, all of the same size and scale whatever they show: pictures of a film.
/// Precondition: as many values as nodes, where there are any.
bool draw_contours(const RunFolder& folder, std::string_view name, std::string_view title,
                   const std::vector<ContourPanel>& panels, std::size_t columns,
                   const ContourRoom& room);
/// One frame of lines that particles drew, with a mark where each began.
struct PathPanel {
    std::string title;
    std::vector<Points<2>> paths;
    /// A dashed closed polygon (a periodic box), or nothing. Paths are cut an eighth beyond it.
    Points<2> frame{};
};

/// `columns` frames in a row, all with the same scale and extent.
bool draw_paths(const RunFolder& folder, std::string_view name, std::string_view title,
                const std::vector<PathPanel>& panels, std::size_t columns);

/// One horizontal bar. What is not finite has no bar, only its text.
struct Bar {
    std::string name;  ///< beside the axis
    double value;
    std::string text{};  ///< at the end of the bar; empty: the value, three digits
    int style = 1;       ///< colour 1 to 6
};

struct BarChart {
    std::string value_label;
    bool log_value = false;  ///< values must be above 0; others have no bar
    std::vector<Bar> bars;   ///< from top to bottom
};

bool draw_bars(const RunFolder& folder, std::string_view name, std::string_view title,
               const BarChart& chart);

/// One choice of several that a table's rows (or columns) run through.
struct HeatAxis {
    std::string name;
    std::vector<std::string> values;
};

/// A table of cases: rows run through all combinations of the row axes (the first varies slowest),
/// columns likewise. Cells are coloured by value and hold a text; a value that is not finite (or on
/// a logarithmic scale not above 0) leaves its cell grey.
struct HeatMap {
    std::vector<HeatAxis> rows, columns;
    std::vector<double> value;      ///< rows x columns, row by row
    std::vector<std::string> text;  ///< likewise, or empty: the values, three digits
    std::string value_label;
    bool log_value = false;
};

/// Precondition: as many values (and texts, if any) as cells.
bool draw_heat_map(const RunFolder& folder, std::string_view name, std::string_view title,
                   const HeatMap& map);

}  // namespace spam

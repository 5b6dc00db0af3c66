// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnuplot_script.hpp"
#include "panel_grid.hpp"
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace spam {
namespace {

using gnuplot::escaped;

constexpr double cell_width = 92.0, cell_height = 48.0, line = 26.0, letter = 10.6;
constexpr double text_line = 20.0;  // of a cell
constexpr double bar = 110.0;       // least width of what is to the right of the table

std::size_t combinations(const std::vector<HeatAxis>& axes, std::size_t first = 0) {
    std::size_t n = 1;
    for (std::size_t a = first; a < axes.size(); ++a) n *= axes[a].values.size();
    return n;
}

/// Width of the column that names an axis of the rows, in pixels.
double label_width(const HeatAxis& axis) {
    std::size_t longest = axis.name.size();
    for (const auto& value : axis.values) longest = std::max(longest, value.size());
    return letter * static_cast<double>(longest) + 18.0;
}

/// Where everything lies: pixels, the first cell's corner at (left, top), y downwards.
struct Geometry {
    double left = 20.0, top, width, height;
    std::size_t rows, columns;

    Geometry(const HeatMap& map, std::string_view title)
        : top(78.0 + line * static_cast<double>(map.columns.size())),
          rows(combinations(map.rows)),
          columns(combinations(map.columns)) {
        for (const auto& axis : map.rows) left += label_width(axis);
        double right = bar;  // the colour bar, and above it the names of the column axes
        for (const auto& axis : map.columns)
            right = std::max(right, letter * static_cast<double>(axis.name.size()) + 20.0);
        width = std::max(left + cell_width * static_cast<double>(columns) + right,
                         letter * static_cast<double>(title.size()) + 40.0);
        height = top + cell_height * static_cast<double>(rows) + 24.0;
    }
    gnuplot::Frame table() const {
        const double high = cell_height * static_cast<double>(rows);
        return {left, height - top - high, {cell_width * static_cast<double>(columns), high}};
    }
    /// A place in the table (columns, rows) on the screen.
    double x(double column) const { return (left + cell_width * column) / width; }
    double y(double row) const { return 1.0 - (top + cell_height * row) / height; }
};

bool has_colour(const HeatMap& map, double value) {
    return std::isfinite(value) && (!map.log_value || value > 0.0);
}

/// The range of colours; never empty.
std::pair<double, double> range_of(const HeatMap& map) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const double v : map.value)
        if (has_colour(map, v)) {
            low = std::min(low, v);
            high = std::max(high, v);
        }
    if (!(low <= high)) return {1.0, 2.0};
    if (low == high) high = low + std::max(1e-12, std::abs(low));
    return {low, high};
}

std::string label_at(const std::string& text, double x, double y, const char* more) {
    return fmt::format("set label \"{}\" at screen {:.5f},{:.5f} {}\n", escaped(text), x, y, more);
}
std::string rule(double x0, double y0, double x1, double y1, double thickness) {
    return fmt::format(
        "set arrow from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} nohead front lw {:g} lc rgb "
        "'#222222'\n",
        x0, y0, x1, y1, thickness);
}

/// Names of the row axes over their values, each once per group; heavier rules for outer groups.
std::string row_labels(const HeatMap& map, const Geometry& g) {
    std::string script;
    double x = 20.0;
    for (std::size_t a = 0; a < map.rows.size(); ++a) {
        const HeatAxis& axis = map.rows[a];
        const std::size_t span = combinations(map.rows, a + 1);
        script += label_at(axis.name, x / g.width, g.y(0) + 12.0 / g.height,
                           "left font 'Sans:Italic,12'");
        for (std::size_t k = 0; k * span < g.rows; ++k) {
            const auto from = static_cast<double>(k * span);
            script += label_at(axis.values[k % axis.values.size()], x / g.width,
                               g.y(from + 0.5 * static_cast<double>(span)), "left");
            if (k > 0 && a + 1 < map.rows.size())
                script += rule(x / g.width, g.y(from), g.x(static_cast<double>(g.columns)),
                               g.y(from), a == 0 ? 2.5 : 1.2);
        }
        x += label_width(axis);
    }
    return script;
}

/// The same above the columns.
std::string column_labels(const HeatMap& map, const Geometry& g) {
    std::string script;
    for (std::size_t a = 0; a < map.columns.size(); ++a) {
        const HeatAxis& axis = map.columns[a];
        const std::size_t span = combinations(map.columns, a + 1);
        const double up = line * static_cast<double>(map.columns.size() - a) - 13.0;
        const double y = g.y(0) + up / g.height;
        script += label_at(axis.name, g.x(static_cast<double>(g.columns)) + 10.0 / g.width, y,
                           "left font 'Sans:Italic,12'");
        for (std::size_t k = 0; k * span < g.columns; ++k) {
            const auto from = static_cast<double>(k * span);
            script += label_at(axis.values[k % axis.values.size()],
                               g.x(from + 0.5 * static_cast<double>(span)), y, "center");
            if (k > 0 && a + 1 < map.columns.size())
                script += rule(g.x(from), y + 13.0 / g.height, g.x(from),
                               g.y(static_cast<double>(g.rows)), a == 0 ? 2.5 : 1.2);
        }
    }
    return script;
}

/// Text of every cell, white on dark colours, black on light ones.
std::string cell_texts(const HeatMap& map, const Geometry& g, double low, double high) {
    const auto scale = [&](double v) { return map.log_value ? std::log(v) : v; };
    std::string script;
    for (std::size_t k = 0; k < map.value.size(); ++k) {
        const double v = map.value[k];
        const bool dark =
            has_colour(map, v) && (scale(v) - scale(low)) / (scale(high) - scale(low)) < 0.6;
        const std::string text = !map.text.empty()  ? map.text[k]
                                 : std::isfinite(v) ? fmt::format("{:.3g}", v)
                                                    : std::string("–");
        // The first of several lines is written at the place: half of the others above the middle.
        const auto more_lines = static_cast<double>(std::count(text.begin(), text.end(), '\n'));
        script += label_at(
            text, g.x(static_cast<double>(k % g.columns) + 0.5),
            g.y(static_cast<double>(k / g.columns) + 0.5) + 0.5 * more_lines * text_line / g.height,
            dark ? "center front tc rgb 'white'" : "center front tc rgb 'black'");
    }
    return script;
}

}  // namespace

bool draw_heat_map(const RunFolder& folder, std::string_view name, std::string_view title,
                   const HeatMap& map) {
    const Geometry g(map, title);
    assert(map.value.size() == g.rows * g.columns);
    assert(map.text.empty() || map.text.size() == map.value.size());
    const auto [low, high] = range_of(map);
    std::string coloured, grey;
    for (std::size_t k = 0; k < map.value.size(); ++k) {
        const auto x = static_cast<double>(k % g.columns), y = static_cast<double>(k / g.columns);
        const std::string box =
            fmt::format("{:g} {:g} {:g} {:g} {:g} {:g}", x + 0.5, y + 0.5, x, x + 1.0, y, y + 1.0);
        if (has_colour(map, map.value[k]))
            coloured += fmt::format("{} {:.10g}\n", box, map.value[k]);
        else
            grey += box + "\n";
    }
    // Rows that only keep an empty block from being an error.
    const std::string nothing = "NaN NaN NaN NaN NaN NaN NaN\n";
    const std::string data = coloured + nothing + "\n\n" + grey + nothing;

    std::string script = gnuplot::preamble(name, g.width, g.height);
    script += gnuplot::palette;
    script += label_at(std::string(title), 0.5, 1.0 - 26.0 / g.height, "center font ',15'");
    script += row_labels(map, g) + column_labels(map, g) + cell_texts(map, g, low, high);
    const double right = g.x(static_cast<double>(g.columns));
    script += gnuplot::margins(g.table(), {g.width, g.height});
    script += fmt::format(
        "set xrange [0:{}]\nset yrange [{}:0]\nunset tics\nunset key\nset border lw 1.2\n"
        "set style fill solid 1 border lc rgb 'white'\n"
        "{}set cbrange [{:.10g}:{:.10g}]\n"
        "set colorbox user origin {:.5f},{:.5f} size {:.5f},{:.5f}\n"
        "set cbtics font ',11'\nset cblabel \"{}\" font ',12'\n"
        "plot '{}.dat' index 0 using 1:2:3:4:5:6:7 with boxxyerror fc palette, "
        "'' index 1 using 1:2:3:4:5:6 with boxxyerror fc rgb '#dddddd'\n",
        g.columns, g.rows, map.log_value ? "set logscale cb\n" : "", low, high,
        right + 14.0 / g.width, g.y(static_cast<double>(g.rows)), 16.0 / g.width,
        (g.y(0) - g.y(static_cast<double>(g.rows))) * 0.8, escaped(map.value_label), name);
    return gnuplot::draw(folder, name, script, data);
}

}  // namespace spam

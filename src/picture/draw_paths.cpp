// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnuplot_script.hpp"
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

using gnuplot::escaped;

constexpr double side = 460.0, gap = 14.0, top = 52.0, title_room = 34.0;

/// The frame that all panels share.
struct Extent {
    double x[2] = {HUGE_VAL, -HUGE_VAL}, y[2] = {HUGE_VAL, -HUGE_VAL};

    void include(const Points<2>& points) {
        for (const auto& point : points.colwise()) {
            x[0] = std::min(x[0], point.x());
            x[1] = std::max(x[1], point.x());
            y[0] = std::min(y[0], point.y());
            y[1] = std::max(y[1], point.y());
        }
    }
    double across() const { return std::max(x[1] - x[0], y[1] - y[0]); }
    /// A margin, no side below a third of the other, and something where there is nothing.
    void settle() {
        if (!(x[1] >= x[0])) x[0] = x[1] = y[0] = y[1] = 0.0;
        const double largest = std::max(across(), 1e-12);
        for (double* range : {x, y}) {
            const double missing = std::max(0.0, 0.34 * largest - (range[1] - range[0]));
            range[0] -= 0.03 * largest + 0.5 * missing;
            range[1] += 0.03 * largest + 0.5 * missing;
        }
    }
};

/// What the frames surround and an eighth more, or without any all paths.
Extent extent_of(const std::vector<PathPanel>& panels) {
    Extent e;
    for (const auto& panel : panels) e.include(panel.frame);
    if (e.x[1] >= e.x[0]) {
        for (double* range : {e.x, e.y}) {
            const double more = 0.125 * e.across();
            range[0] -= more;
            range[1] += more;
        }
    } else {
        for (const auto& panel : panels)
            for (const auto& path : panel.paths) e.include(path);
    }
    e.settle();
    return e;
}

std::string points_of(const Points<2>& line) {
    std::string block;
    for (const auto& point : line.colwise())
        block += fmt::format("{:.7g} {:.7g}\n", point.x(), point.y());
    return block;
}

/// Lines of all particles, then where they begin, then the frame: three blocks.
std::string blocks_of(const PathPanel& panel) {
    const std::string nothing = "NaN NaN\n";  // keeps an empty block from being an error
    std::string lines, starts;
    for (const auto& path : panel.paths) {
        if (path.cols() == 0) continue;
        lines += points_of(path) + "\n";
        starts += points_of(path.leftCols(1));
    }
    std::string frame = points_of(panel.frame);
    if (panel.frame.cols() > 0) frame += points_of(panel.frame.leftCols(1));
    return lines + nothing + "\n\n" + starts + nothing + "\n\n" + frame + nothing + "\n\n";
}

}  // namespace

bool draw_paths(const RunFolder& folder, std::string_view name, std::string_view title,
                const std::vector<PathPanel>& panels, std::size_t columns) {
    columns = std::max<std::size_t>(1, std::min(columns, panels.size()));
    const std::size_t rows = (panels.size() + columns - 1) / columns;
    const Extent e = extent_of(panels);
    const double scale = side / e.across();
    const double frame_width = (e.x[1] - e.x[0]) * scale, frame_height = (e.y[1] - e.y[0]) * scale;
    const double width = gap + (frame_width + gap) * static_cast<double>(columns);
    const double height = top + (frame_height + title_room + gap) * static_cast<double>(rows);

    std::string data, script = gnuplot::preamble(name, width, height);
    script += fmt::format(
        "set label 100 \"{}\" at screen 0.5,{:.5f} center font ',15'\nset multiplot\n"
        "set xrange [{:g}:{:g}]\nset yrange [{:g}:{:g}]\n"
        "unset tics\nunset key\nset border lc rgb '#bbbbbb'\n",
        escaped(title), 1.0 - 24.0 / height, e.x[0], e.x[1], e.y[0], e.y[1]);
    for (std::size_t k = 0; k < panels.size(); ++k) {
        data += blocks_of(panels[k]);
        const double left = gap + (frame_width + gap) * static_cast<double>(k % columns);
        const double up =
            top + title_room + (frame_height + title_room + gap) * static_cast<double>(k / columns);
        script += fmt::format(
            "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
            "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n"
            "set label 1 \"{}\" at screen {:.5f},{:.5f} center font ',13'\n"
            "plot '{}.dat' index {} with lines lw 0.9 lc rgb '#3b528b', "
            "'' index {} with points pt 7 ps 0.45 lc rgb '#d55e00', "
            "'' index {} with lines lw 1.2 dt (6,5) lc rgb '#777777'\n",
            left / width, (left + frame_width) / width, 1.0 - up / height,
            1.0 - (up + frame_height) / height, escaped(panels[k].title),
            (left + 0.5 * frame_width) / width, 1.0 - (up - 16.0) / height, name, 3 * k, 3 * k + 1,
            3 * k + 2);
        if (k == 0) script += "unset label 100\n";
    }
    script += "unset multiplot\n";
    return gnuplot::draw(folder, name, script, data);
}

}  // namespace spam

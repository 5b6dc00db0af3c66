// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnuplot_script.hpp"
#include "panel_grid.hpp"
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

using gnuplot::escaped;
using gnuplot::Extent;

constexpr double side = 460.0, gap = 14.0, top = 52.0, title_room = 34.0;

/// What the frames surround and an eighth more, or without any all paths; with a margin, no side below a third of the
/// other.
Extent extent_of(const std::vector<PathPanel>& panels) {
    Extent e;
    for (const auto& panel : panels) e.include(panel.frame);
    if (!e.empty())
        e.add_margin(0.125 * e.across());
    else
        for (const auto& panel : panels)
            for (const auto& path : panel.paths) e.include(path);
    if (e.empty()) e = {{0.0, 0.0}, {0.0, 0.0}};
    const double largest = std::max(e.across(), 1e-12);
    e.widen(0.34 * largest);
    e.add_margin(0.03 * largest);
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
    const Extent e = extent_of(panels);
    const double scale = side / e.across();
    const gnuplot::PanelGrid grid(panels.size(), columns, {e.width() * scale, e.height() * scale},
                                  {{.left = 0.0, .right = gap, .bottom = gap, .top = title_room}},
                                  {.left = gap, .top = top});

    std::string data, script = gnuplot::preamble(name, grid.width(), grid.height());
    script += fmt::format(
        "set label 100 \"{}\" at screen 0.5,{:.5f} center font ',15'\nset multiplot\n"
        "set xrange [{:.12g}:{:.12g}]\nset yrange [{:.12g}:{:.12g}]\n"
        "unset tics\nunset key\nset border lc rgb '#bbbbbb'\n",
        escaped(title), 1.0 - 24.0 / grid.height(), e.x[0], e.x[1], e.y[0], e.y[1]);
    for (std::size_t k = 0; k < panels.size(); ++k) {
        data += blocks_of(panels[k]);
        const gnuplot::Frame frame = grid.frame(k);
        script += grid.place(k);
        script += fmt::format(
            "set label 1 \"{}\" at screen {} center font ',13'\n"
            "plot '{}.dat' index {} with lines lw 0.9 lc rgb '#3b528b', "
            "'' index {} with points pt 7 ps 0.45 lc rgb '#d55e00', "
            "'' index {} with lines lw 1.2 dt (6,5) lc rgb '#777777'\n",
            escaped(panels[k].title),
            grid.at(frame.left + 0.5 * frame.size.width, frame.top() + 16.0), name, 3 * k,
            3 * k + 1, 3 * k + 2);
        if (k == 0) script += "unset label 100\n";
    }
    script += "unset multiplot\n";
    return gnuplot::draw(folder, name, script, data);
}

}  // namespace spam

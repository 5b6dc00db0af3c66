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

constexpr double across = 300.0, gap = 10.0, top = 44.0;  // the longer side of a frame
constexpr double title_room = 24.0, side_room = 34.0, key_room = 62.0;  // where a row has them

/// A field between its nodes, bilinear.
class Surface {
  public:
    explicit Surface(const ContourPanel& panel) : panel_(panel) {}

    double operator()(double x, double y) const {
        const auto [i, s] = cell(0, x);
        const auto [j, t] = cell(1, y);
        return (1 - t) * ((1 - s) * node(i, j) + s * node(i + 1, j)) +
               t * ((1 - s) * node(i, j + 1) + s * node(i + 1, j + 1));
    }

  private:
    int nodes(int a) const { return panel_.grid.nodes[static_cast<std::size_t>(a)]; }
    /// The node below x along axis a, and how far x is beyond it.
    std::pair<int, double> cell(int a, double x) const {
        double c = (x - panel_.grid.origin(a)) / panel_.grid.spacing(a);
        if (!panel_.periodic) c = std::clamp(c, 0.0, nodes(a) - 1.0);
        const double below = std::floor(c);
        return {static_cast<int>(below), c - below};
    }
    double node(int i, int j) const {
        const auto at = [&](int a, int k) {
            const int n = nodes(a);
            return panel_.periodic ? ((k % n) + n) % n : std::clamp(k, 0, n - 1);
        };
        return panel_.values[static_cast<std::size_t>(at(0, i) + nodes(0) * at(1, j))];
    }
    const ContourPanel& panel_;
};

/// Frames as long as `across`, rows with room for titles and colour bars where they have any.
gnuplot::PanelGrid grid_of(std::string_view title, const std::vector<ContourPanel>& panels,
                           std::size_t most_columns, const ContourRoom& room) {
    const Point<2> size = room.high - room.low;
    const std::size_t columns = std::max<std::size_t>(1, std::min(most_columns, panels.size()));
    std::vector<gnuplot::Room> around((panels.size() + columns - 1) / columns,
                                      {.right = gap, .bottom = gap});
    around.resize(std::max<std::size_t>(1, around.size()));
    double left = gap;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        gnuplot::Room& row = around[k / columns];
        if (!panels[k].side.empty()) left = side_room;
        if (!panels[k].title.empty()) row.top = title_room;
        if (panels[k].colours) row.bottom = gap + key_room;
    }
    gnuplot::PanelGrid grid(
        panels.size(), columns,
        {across * size(0) / size.maxCoeff(), across * size(1) / size.maxCoeff()}, around,
        {.left = left, .top = top});
    grid.grow_to(title, gap);
    grid.make_even();
    return grid;
}

/// One number a pixel, row by row from below: 0 (black) to 9, or the value to be coloured.
std::string pixels(const ContourPanel& panel, const gnuplot::Size& frame, const ContourRoom& room) {
    const Surface f(panel);
    const auto nx = static_cast<int>(std::lround(frame.width)),
               ny = static_cast<int>(std::lround(frame.height));
    const double dx = (room.high(0) - room.low(0)) / nx, dy = (room.high(1) - room.low(1)) / ny;
    std::string block;
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            const double x = room.low(0) + (i + 0.5) * dx, y = room.low(1) + (j + 0.5) * dy;
            const double value = f(x, y);
            if (panel.colours) {
                block += fmt::format("{:.4g} ", value);
                continue;
            }
            // The part of the pixel above the level: no steps along the contour.
            const double slope = std::abs(f(x + 0.5 * dx, y) - f(x - 0.5 * dx, y)) +
                                 std::abs(f(x, y + 0.5 * dy) - f(x, y - 0.5 * dy));
            const double above = value - panel.level;
            const double part =
                slope > 0.0 ? std::clamp(0.5 + above / slope, 0.0, 1.0) : (above > 0.0 ? 1.0 : 0.0);
            block += fmt::format("{} ", std::lround(9.0 * part));
        }
        block += '\n';
    }
    return block + "\n\n";
}

std::string dots(const ContourPanel& panel) {
    std::string block;
    for (const auto& r : panel.particles.colwise())
        block += fmt::format("{:.6g} {:.6g}\n", r.x(), r.y());
    return block + (block.empty() ? "NaN NaN\n\n\n" : "\n\n");
}

/// Place, title and name of panel k. A grid may be wider than its panels, which then are in its middle.
std::string place_of(const ContourPanel& panel, std::size_t k, const gnuplot::PanelGrid& grid) {
    const gnuplot::Frame frame = grid.frame(k);
    const double middle = frame.left + 0.5 * frame.size.width;
    std::string script = grid.place(k) + "unset label\n";
    if (!panel.title.empty())
        script +=
            fmt::format("set label \"{}\" at screen {} center font ',13'\n", escaped(panel.title),
                        grid.at(middle, frame.top() + 0.5 * title_room));
    if (!panel.side.empty())
        script += fmt::format("set label \"{}\" at screen {} center rotate by 90 font ',13'\n",
                              escaped(panel.side),
                              grid.at(grid.frame(k - k % grid.columns()).left - 0.5 * side_room,
                                      frame.bottom + 0.5 * frame.size.height));
    if (!panel.colours) return script + "unset colorbox\n";
    return script +
           fmt::format(
               "set colorbox horizontal user origin {} size {}\n"
               "set cbtics font ',11' offset 0,0.4 tc rgb 'black'\nset cblabel \"{}\" "
               "font ',12' tc rgb 'black' offset 0,1.1\n",
               grid.at(frame.left + 0.1 * frame.size.width, frame.bottom - 0.35 * key_room),
               grid.at(0.8 * frame.size.width, 10.0), escaped(panel.colours->label));
}

std::string plot_of(const ContourPanel& panel, std::string_view name, std::size_t block,
                    const gnuplot::Size& frame) {
    if (panel.values.empty())
        return fmt::format(
            "plot '{}.dat' index {} using 1:2:({:.5g}) with circles fc rgb '#000000'\n", name,
            block, 0.5 * panel.dot);
    const std::string colours =
        panel.colours ? fmt::format("{}set cbrange [{:.12g}:{:.12g}]\n", gnuplot::palette,
                                    panel.colours->low, panel.colours->high)
                      : std::string("set palette gray\nset cbrange [0:9]\n");
    // Axes that count pixels: to compute the place of each takes gnuplot ten times as long as to draw it.
    return colours + fmt::format(
                         "set x2range [-0.5:{}]\nset y2range [-0.5:{}]\n"
                         "plot '{}.dat' index {} matrix axes x2y2 with image\n",
                         std::round(frame.width) - 0.5, std::round(frame.height) - 0.5, name,
                         block);
}

}  // namespace

bool draw_contours(const RunFolder& folder, std::string_view name, std::string_view title,
                   const std::vector<ContourPanel>& panels, std::size_t columns,
                   const ContourRoom& room) {
    const gnuplot::PanelGrid grid = grid_of(title, panels, columns, room);
    std::string data, script = gnuplot::preamble(name, grid.width(), grid.height());
    script += fmt::format(
        "set multiplot\nset label 1 \"{}\" at screen 0.5,{:.6f} center font ',15'\n"
        "set xrange [{:.10g}:{:.10g}]\nset yrange [{:.10g}:{:.10g}]\n"
        "unset tics\nunset key\nset border lc rgb '#888888'\nset style fill solid 1 noborder\n",
        escaped(title), 1.0 - 0.5 * top / grid.height(), room.low(0), room.high(0), room.low(1),
        room.high(1));
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const ContourPanel& panel = panels[k];
        assert(panel.values.empty() || panel.values.size() == panel.grid.size());
        const gnuplot::Size frame = grid.frame(k).size;
        data += panel.values.empty() ? dots(panel) : pixels(panel, frame, room);
        std::string place = place_of(panel, k, grid);
        if (k == 0) place.erase(place.find("unset label\n"), 12);  // the picture's own title
        script += place + plot_of(panel, name, k, frame);
    }
    script += "unset multiplot\n";
    return gnuplot::draw(folder, name, script, data);
}

}  // namespace spam

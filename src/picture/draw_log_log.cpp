// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnuplot_script.hpp"
#include "panel_grid.hpp"
#include <spam/core/text.hpp>
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace spam {
namespace {

using gnuplot::escaped;

constexpr gnuplot::Size frame_size{485.0, 325.0};
constexpr gnuplot::Room axes{.left = 115.0, .right = 20.0, .bottom = 75.0, .top = 30.0};
constexpr double top = 56.0, key_line = 26.0;

/// Distinct without colour vision, together with the marks (gnuplot's open ones; filled: one more).
constexpr std::array colours{"#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7",
                             "#e69f00", "#56b4e9", "#7b3f9e", "#8c6d31", "#999999"};
constexpr std::array open_marks{6, 4, 8, 10, 12, 14};

std::string look(const LogLogPicture& picture, std::size_t key, bool open) {
    const int mark = open_marks[key % open_marks.size()] + (open ? 0 : 1);
    return fmt::format("{} lc rgb '{}' lw {} dt {}{}", picture.marks ? "linespoints" : "lines",
                       colours[key % colours.size()], open ? 1.4 : 2.0, open ? 2 : 1,
                       picture.marks ? fmt::format(" pt {} ps 1.1", mark) : "");
}

bool shown(double x, double y) {
    return std::isfinite(x) && std::isfinite(y) && x > 0.0 && y > 0.0;
}

/// A range with a tick at each decade (or every second, third where they are many).
std::string axis(char name, double low, double high, double most_labels) {
    if (!(low <= high)) low = 0.1, high = 1.0;
    double from = std::floor(std::log10(low) + 1e-9), to = std::ceil(std::log10(high) - 1e-9);
    if (to <= from) to = from + 1.0;
    const double every = std::max(1.0, std::ceil((to - from) / most_labels));
    const bool decades = high >= 20.0 * low;  // else the whole decade, or no tick would be seen
    return fmt::format(
        "set {0}range [{1:.4g}:{2:.4g}]\nset {0}tics 1e{3:.0f},1e{4:.0f}\nset m{0}tics {5}\n"
        "set format {0} '10^{{%L}}'\n",
        name, decades ? low / 1.5 : std::pow(10.0, from), decades ? high * 1.5 : std::pow(10.0, to),
        from, every, every > 1.0 ? 1 : 10);
}

std::string ranges(const LogLogPanel& panel) {
    double x0 = HUGE_VAL, x1 = 0.0, y0 = HUGE_VAL, y1 = 0.0;
    for (const auto& curve : panel.curves)
        for (std::size_t k = 0; k < curve.x.size(); ++k) {
            if (!shown(curve.x[k], curve.y[k])) continue;
            x0 = std::min(x0, curve.x[k]);
            x1 = std::max(x1, curve.x[k]);
            y0 = std::min(y0, curve.y[k]);
            y1 = std::max(y1, curve.y[k]);
        }
    if (panel.floor > 0.0) y0 = std::min(y0, panel.floor);
    return axis('x', x0, x1, 8.0) + axis('y', y0, y1, 9.0);
}

/// Entries of the key that have a curve.
std::vector<std::size_t> keys_drawn(const LogLogPicture& picture) {
    std::set<std::size_t> drawn;
    for (const auto& panel : picture.panels)
        for (const auto& curve : panel.curves)
            if (!curve.x.empty()) drawn.insert(curve.key);
    return {drawn.begin(), drawn.end()};
}

/// Entries in rows under the frames, each with its line and mark.
std::string key(const LogLogPicture& picture, double width, double height, std::size_t per_row) {
    std::string script;
    const auto drawn = keys_drawn(picture);
    const std::size_t rows = (drawn.size() + per_row - 1) / per_row;
    const double base = key_line * (picture.note.empty() ? 0.5 : 1.5);
    for (std::size_t place = 0; place < drawn.size(); ++place) {
        const std::size_t k = drawn[place];
        const double x = (40.0 + (width - 60.0) * static_cast<double>(place % per_row) /
                                     static_cast<double>(per_row)) /
                         width;
        const double y =
            (base + key_line * static_cast<double>(rows - 1 - place / per_row)) / height;
        script += fmt::format(
            "set arrow {0} from screen {1:.4f},{2:.4f} to screen {3:.4f},{2:.4f} nohead lw 2 lc "
            "rgb "
            "'{4}'\n",
            k + 1, x, y, x + 34.0 / width, colours[k % colours.size()]);
        if (picture.marks)
            script += fmt::format(
                "set label {} '' at screen {:.4f},{:.4f} point pt {} ps 1.2 lc rgb '{}'\n", k + 101,
                x + 17.0 / width, y, open_marks[k % open_marks.size()] + 1,
                colours[k % colours.size()]);
        script += fmt::format("set label {} \"{}\" at screen {:.4f},{:.4f} left\n", k + 1,
                              escaped(picture.key[k]), x + 42.0 / width, y);
    }
    if (!picture.note.empty())
        script += fmt::format("set label 99 \"{}\" at screen {:.4f},{:.4f} left\n",
                              escaped(picture.note), 40.0 / width, 0.5 * key_line / height);
    return script;
}

std::string data_of(const LogLogPanel& panel) {
    std::string data;
    for (const auto& curve : panel.curves) {
        data += fmt::format("# {}, entry {} of the key\n", one_line(panel.title), curve.key + 1);
        bool any = false;
        for (std::size_t k = 0; k < curve.x.size(); ++k) {
            if (!shown(curve.x[k], curve.y[k])) continue;
            data += fmt::format("{:.10g} {:.10g}\n", curve.x[k], curve.y[k]);
            any = true;
        }
        data += any ? "\n\n" : "NaN NaN\n\n\n";
    }
    return data;
}

/// What a frame plots: its curves, and the floor.
std::string plots(const LogLogPicture& picture, const LogLogPanel& panel, std::string_view name,
                  std::size_t& block) {
    std::string text = "plot ";
    if (panel.floor > 0.0)
        text +=
            fmt::format("{:.6g} with lines lc rgb '#888888' lw 1.5 dt 3 notitle, ", panel.floor);
    for (const auto& curve : panel.curves)
        text += fmt::format("'{}.dat' index {} with {} notitle, ", name, block++,
                            look(picture, curve.key, curve.open));
    if (panel.curves.empty() && !(panel.floor > 0.0)) return "plot NaN notitle\n";
    text.resize(text.size() - 2);
    return text + "\n";
}

}  // namespace

bool draw_log_log(const RunFolder& folder, std::string_view name, const LogLogPicture& picture) {
    // The key has two entries a panel in a row, and there is at least one panel in a row.
    const std::size_t per_row =
        2 * std::max<std::size_t>(1, std::min(picture.columns, picture.panels.size()));
    const double bottom =
        key_line * (static_cast<double>((keys_drawn(picture).size() + per_row - 1) / per_row) +
                    (picture.note.empty() ? 0.0 : 1.0)) +
        10.0;
    gnuplot::PanelGrid grid(picture.panels.size(), picture.columns, frame_size, {axes},
                            {.bottom = bottom, .top = top});
    grid.grow_to(picture.title, axes.right);
    std::string data, script = gnuplot::preamble(name, grid.width(), grid.height());
    script += fmt::format(
        "set multiplot title \"{}\" font ',15'\nset logscale xy\nset border 3\nset tics nomirror\n"
        "set grid back lt 1 lw 1 lc rgb '#e4e4e4'\n",
        escaped(picture.title));
    std::size_t block = 0;
    for (std::size_t k = 0; k < picture.panels.size(); ++k) {
        const LogLogPanel& panel = picture.panels[k];
        script += grid.place(k);
        script += fmt::format(
            "set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"{}\" offset -1,0\n{}",
            escaped(panel.title), escaped(panel.x_label), escaped(panel.y_label), ranges(panel));
        script += "unset label\nunset arrow\n";
        if (k == 0) script += key(picture, grid.width(), grid.height(), per_row);
        if (!panel.words.empty())
            script += fmt::format("set label 98 \"{}\" at graph 0.98,0.95 right tc rgb '#555555'\n",
                                  escaped(panel.words));
        data += data_of(panel);
        script += plots(picture, panel, name, block);
    }
    script += "unset multiplot\n";
    return gnuplot::draw(folder, name, script, data);
}

}  // namespace spam

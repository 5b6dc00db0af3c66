// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnuplot_script.hpp"
#include "panel_grid.hpp"
#include <spam/core/text.hpp>
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

using gnuplot::escaped;

constexpr gnuplot::Size frame_size{505.0, 318.6};
/// Above it titles, below it numbers, their name and the key.
constexpr gnuplot::Room axes{.left = 115.0, .right = 20.0, .bottom = 129.6, .top = 91.8};

constexpr double key_below = 94.0;  ///< a frame

/// Of the curves with a look of their own, and so a place in the key.
std::vector<std::string> key_titles(const CurvePanel& panel) {
    std::vector<std::string> titles;
    for (const Curve& curve : panel.curves)
        if (curve.like == 0) titles.push_back(curve.title);
    return titles;
}

bool same_titles(const std::vector<CurvePanel>& panels) {
    return panels.size() > 1 && std::ranges::all_of(panels, [&](const CurvePanel& panel) {
               return key_titles(panel) == key_titles(panels.front());
           });
}

/// Line style of curve k: its own, that of the one it is like, or its place among those of their own.
int style_of(const CurvePanel& panel, std::size_t k) {
    const Curve& curve = panel.curves[k];
    if (curve.like > 0) return curve.like;
    if (curve.style > 0) return curve.style;
    const auto before = panel.curves.begin() + static_cast<std::ptrdiff_t>(k);
    const auto own =
        std::count_if(panel.curves.begin(), before, [](const Curve& c) { return c.like == 0; });
    return static_cast<int>(own) % gnuplot::styles + 1;
}

/// One row under the whole picture: gnuplot's own key is no wider than its frame.
std::string shared_key(const CurvePanel& panel) {
    std::string key = "unset key\n";
    std::vector<std::size_t> named;
    for (std::size_t k = 0; k < panel.curves.size(); ++k)
        if (panel.curves[k].like == 0) named.push_back(k);
    const auto n = static_cast<double>(named.size());
    for (std::size_t place = 0; place < named.size(); ++place) {
        const std::size_t k = named[place];
        const double x = (static_cast<double>(place) + 0.12) / n;
        const int style = style_of(panel, k);
        if (panel.curves[k].mark == Mark::points)
            key += fmt::format("set label {0} \"\" at screen {1:.4f},0.06 point ls {2} ps 1.2\n",
                               panel.curves.size() + k + 1, x + 0.014, style);
        else
            key += fmt::format(
                "set arrow {0} from screen {1:.4f},0.06 to screen {2:.4f},0.06 nohead ls {3}\n",
                k + 1, x, x + 0.028, style);
        key += fmt::format("set label {0} \"{1}\" at screen {2:.4f},0.06 left\n", k + 1,
                           escaped(panel.curves[k].title), x + 0.036);
    }
    return key;
}

/// Numbers along the x axis, or the panel's own names with a line at each.
std::string x_axis(const CurvePanel& panel) {
    if (panel.x_ticks.empty()) return "set xtics autofreq\n";
    std::string ticks;
    for (const Tick& tick : panel.x_ticks)
        ticks +=
            fmt::format("{}\"{}\" {:.8g}", ticks.empty() ? "" : ", ", escaped(tick.label), tick.at);
    return fmt::format("set xtics ({})\n", ticks);
}

/// How curve k is drawn and named.
std::string look_of(const CurvePanel& panel, std::size_t k) {
    const Curve& curve = panel.curves[k];
    const std::string look =
        fmt::format("{} ls {}{}", curve.mark == Mark::points ? "points" : "lines",
                    style_of(panel, k), curve.like > 0 ? " lw 1.6 dt (8,6)" : "");
    return curve.title.empty() ? look + " notitle"
                               : fmt::format("{} title \"{}\"", look, escaped(curve.title));
}

/// One curve as a block of the data file; a curve without points keeps its place in the key.
std::string curve_block(const CurvePanel& panel, const Curve& curve) {
    std::string block = fmt::format("# {}: {}\n", one_line(panel.title), one_line(curve.title));
    bool any = false;
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
        const double y = panel.log_y ? std::abs(curve.y[k]) : curve.y[k];
        if (!std::isfinite(y) || (panel.log_y && y == 0.0)) continue;
        block += fmt::format("{:.10g} {:.10g}\n", curve.x[k], y);
        any = true;
    }
    return block + (any ? "\n\n" : "NaN NaN\n\n\n");
}

/// Ranges as the points have them; where there are none (all changes zero on a logarithmic scale) or
/// all lie above each other gnuplot would give up.
std::string ranges(const CurvePanel& panel) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Curve& curve : panel.curves)
        for (std::size_t k = 0; k < curve.x.size(); ++k) {
            if (!std::isfinite(curve.y[k]) || (panel.log_y && curve.y[k] == 0.0)) continue;
            low = std::min(low, curve.x[k]);
            high = std::max(high, curve.x[k]);
        }
    if (!(low <= high)) return "set xrange [0:1]\nset yrange [0.1:1]\n";
    const bool degenerate =
        !(high - low > 1e-12 * std::max(std::abs(low), std::abs(high))) || high - low < 1e-290;
    const double room = std::max(1.0, 1e-3 * std::abs(low));
    return (degenerate ? fmt::format("set xrange [{:.12g}:{:.12g}]\n", low - room, high + room)
                       : std::string("set autoscale x\nset autoscale xfix\n")) +
           "set autoscale y\n";
}

/// Labels and scale of a frame.
std::string labels(const CurvePanel& panel) {
    return fmt::format("set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"{}\" offset -1,0\n{}{}{}",
                       escaped(panel.title), escaped(panel.x_label), escaped(panel.y_label),
                       ranges(panel), x_axis(panel),
                       panel.log_y ? "set logscale y\nset format y '10^{%L}'\n"
                                   : "unset logscale y\nset format y '%g'\n");
}

}  // namespace

Curve steps(std::string title, const std::vector<double>& centre, const std::vector<double>& height,
            double width) {
    Curve curve{std::move(title), {}, {}};
    for (std::size_t b = 0; b < centre.size(); ++b) {
        curve.x.insert(curve.x.end(), {centre[b] - 0.5 * width, centre[b] + 0.5 * width});
        curve.y.insert(curve.y.end(), {height[b], height[b]});
    }
    return curve;
}

bool draw_curves(const RunFolder& folder, std::string_view name, std::string_view title,
                 const std::vector<CurvePanel>& panels, std::size_t columns) {
    // One key for all frames where they show the same curves: under the middle of the picture.
    const bool shared = same_titles(panels);
    gnuplot::PanelGrid grid(panels.size(), columns > 0 ? columns : panels.size(), frame_size,
                            {axes});
    grid.grow_to(title, axes.right);
    std::string data, script = gnuplot::preamble(name, grid.width(), grid.height());
    script += gnuplot::line_styles;
    script += fmt::format("set multiplot title \"{}\" font ',15'\n", escaped(title));
    script +=
        "set grid back lt 1 lw 1 lc rgb '#e4e4e4'\nset border 3\nset tics nomirror\n"
        "set autoscale xfix\n";
    int block = 0;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const CurvePanel& panel = panels[k];
        script += grid.place(k) + labels(panel);
        script += shared
                      ? (k == 0 ? shared_key(panel) : std::string("unset label\nunset arrow\n"))
                      : fmt::format("set key at screen {} center horizontal samplen 2 maxrows 2\n",
                                    grid.at(grid.frame(k).left + 0.5 * frame_size.width,
                                            grid.frame(k).bottom - key_below));
        std::string plots;
        for (std::size_t c = 0; c < panel.curves.size(); ++c) {
            data += curve_block(panel, panel.curves[c]);
            plots += fmt::format("{} '{}.dat' index {} with {}", plots.empty() ? "plot" : ",", name,
                                 block++, look_of(panel, c));
        }
        script += plots + "\n";
    }
    script += "unset multiplot\n";
    return gnuplot::draw(folder, name, script, data);
}

}  // namespace spam

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

constexpr double frame_width = 660.0;

bool has_bar(const BarChart& chart, double value) {
    return std::isfinite(value) && (!chart.log_value || value > 0.0);
}

struct Axis {
    double from, to;
};

std::string text_of(const Bar& bar) {
    return bar.text.empty() ? fmt::format("{:.3g}", bar.value) : bar.text;
}

/// The share of the frame's width that a bar's text takes.
double text_share(const Bar& bar) {
    return std::min(0.6, (9.4 * static_cast<double>(text_of(bar).size()) + 20.0) / frame_width);
}

/// From zero (from the decade below the smallest, if logarithmic), with room for the texts.
Axis axis_of(const BarChart& chart) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Bar& bar : chart.bars)
        if (has_bar(chart, bar.value)) {
            low = std::min(low, bar.value);
            high = std::max(high, bar.value);
        }
    if (!(low <= high)) return chart.log_value ? Axis{0.1, 1.0} : Axis{0.0, 1.0};
    if (chart.log_value) {
        const double from = std::pow(10.0, std::ceil(std::log10(low)) - 1.0);
        double decades = 0.0;
        for (const Bar& bar : chart.bars)
            if (has_bar(chart, bar.value))
                decades = std::max(decades, std::log10(bar.value / from) / (1.0 - text_share(bar)));
        return {from, from * std::pow(10.0, decades)};
    }
    double share = 0.18;
    for (const Bar& bar : chart.bars) share = std::max(share, text_share(bar));
    const double room = share / (1.0 - share) * (std::max(high, 0.0) - std::min(low, 0.0));
    return {low < 0.0 ? low - room : 0.0, high > 0.0 ? high + room : room};
}

}  // namespace

bool draw_bars(const RunFolder& folder, std::string_view name, std::string_view title,
               const BarChart& chart) {
    const Axis axis = axis_of(chart);
    const double foot = chart.log_value ? axis.from : 0.0;
    std::size_t longest = 0;
    for (const Bar& bar : chart.bars) longest = std::max(longest, bar.name.size());
    const double row = 34.0, left = 40.0 + 8.6 * static_cast<double>(longest), top = 60.0;
    const double width = left + frame_width + 20.0,
                 height = top + 80.0 + row * static_cast<double>(chart.bars.size());

    std::string data, script = gnuplot::preamble(name, width, height);
    script += gnuplot::line_styles;
    script += fmt::format(
        "set title \"{}\" font ',15'\nset xlabel \"{}\"\nset xrange [{:.12g}:{:.12g}]\n"
        "set yrange [{}.5:-0.5]\n"
        "set border 3\nset xtics nomirror\nset ytics scale 0 nomirror ()\nunset key\n"
        "set grid xtics back lt 1 lw 1 lc rgb '#e4e4e4'\nset style fill solid 0.85 noborder\n{}",
        escaped(title), escaped(chart.value_label), axis.from, axis.to,
        static_cast<int>(chart.bars.size()) - 1,
        chart.log_value ? "set logscale x\nset format x '10^{%L}'\n" : "");
    script += gnuplot::margins({left, 65.0, {frame_width, height - top - 65.0}}, {width, height});
    std::string plots;
    for (std::size_t k = 0; k < chart.bars.size(); ++k) {
        const Bar& bar = chart.bars[k];
        const bool drawn = has_bar(chart, bar.value);
        const double end = drawn ? bar.value : foot;
        const auto y = static_cast<double>(k);
        data += fmt::format("{0:.10g} {1:g} {2:.10g} {3:.10g} {4:g} {5:g}\n\n\n", end, y,
                            std::min(foot, end), std::max(foot, end), y - 0.34, y + 0.34);
        script += fmt::format("set ytics add (\"{}\" {})\nset label \" {} \" at {:.10g},{} {}\n",
                              escaped(bar.name), k, escaped(text_of(bar)), end, k,
                              end < foot ? "right" : "left");
        plots += fmt::format("{} '{}.dat' index {} with boxxyerror ls {}",
                             plots.empty() ? "plot" : ",", name, k, std::max(1, bar.style));
    }
    return gnuplot::draw(folder, name, script + plots + "\n", data);
}

}  // namespace spam

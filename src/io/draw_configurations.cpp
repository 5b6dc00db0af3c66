// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnuplot_script.hpp"
#include <spam/io/gnuplot.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam {
namespace {

using gnuplot::escaped;

constexpr double side = 340.0, bar = 112.0, top = 50.0;  // of a frame, of the colour bar, the title

/// What all frames have in common.
struct Extent {
    double reach = 1e-300;  ///< largest coordinate
    double low = HUGE_VAL, high = -HUGE_VAL;
    double spacing = HUGE_VAL;  ///< a particle is drawn about as wide as its share of the frame
};

Extent extent_of(const std::vector<ConfigurationPanel>& panels) {
    Extent e;
    for (const auto& panel : panels) {
        if (panel.position.cols() > 0)
            e.reach = std::max(e.reach, panel.position.cwiseAbs().maxCoeff());
        for (const double c : panel.colour) {
            e.low = std::min(e.low, c);
            e.high = std::max(e.high, c);
        }
    }
    e.spacing = 2.0 * e.reach;
    for (const auto& panel : panels)
        if (panel.position.cols() > 1)
            e.spacing = std::min(
                e.spacing, 1.7 * e.reach / std::sqrt(static_cast<double>(panel.position.cols())));
    if (!(e.high > e.low)) e.high = e.low + 1.0;
    return e;
}

std::string particle_block(const ConfigurationPanel& panel) {
    std::string block;
    for (Eigen::Index i = 0; i < panel.position.cols(); ++i)
        block += fmt::format("{:.8g} {:.8g} {:.8g}\n", panel.position(0, i), panel.position(1, i),
                             panel.colour[static_cast<std::size_t>(i)]);
    return block + "\n\n";
}

std::string outline_block(const Points<2>& outline) {
    std::string block;
    for (Eigen::Index i = 0; i <= outline.cols(); ++i)
        block += fmt::format("{:.8g} {:.8g}\n", outline(0, i % outline.cols()),
                             outline(1, i % outline.cols()));
    return block + "\n\n";
}

}  // namespace

bool draw_configurations(const RunFolder& folder, std::string_view name, std::string_view title,
                         const std::vector<ConfigurationPanel>& panels, std::size_t columns,
                         std::string_view colour_label) {
    columns = std::max<std::size_t>(1, std::min(columns, panels.size()));
    const std::size_t rows = (panels.size() + columns - 1) / columns;
    const Extent e = extent_of(panels);
    const double width = side * static_cast<double>(columns) + bar;
    const double height = side * static_cast<double>(rows) + top;

    std::string data, script = gnuplot::preamble(name, width, height);
    script += gnuplot::palette;
    script += fmt::format(
        "set multiplot title \"{}\" font ',15' offset 0,-0.2\n"
        "set cbrange [{:g}:{:g}]\nset xrange [{:g}:{:g}]\nset yrange [{:g}:{:g}]\n"
        "unset tics\nunset key\nset border lc rgb '#bbbbbb'\nset style fill solid 1 noborder\n",
        escaped(title), e.low, e.high, -1.13 * e.reach, 1.13 * e.reach, -1.03 * e.reach,
        1.23 * e.reach);  // titles on top
    int block = 0;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const auto& panel = panels[k];
        data += particle_block(panel);
        const int points = block++;
        std::string lines;
        for (const auto& outline : panel.outlines) {
            data += outline_block(outline);
            lines += fmt::format(", '{}.dat' index {} with lines lw 1.2 lc rgb '#333333'", name,
                                 block++);
        }
        const auto row = static_cast<double>(k / columns),
                   column = static_cast<double>(k % columns);
        const double left = side * column / width,
                     bottom = (height - top - side * (row + 1)) / height;
        script += fmt::format(
            "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
            "set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n"
            "set label 1 \"{}\" at graph 0.5,0.962 center font ',12'\n",
            left + 6 / width, left + (side - 6) / width, bottom + 6 / height,
            bottom + (side - 6) / height, escaped(panel.title));
        script += k == 0
                      ? fmt::format(
                            "set colorbox user origin {:.5f},{:.5f} size {:.5f},{:.5f}\n"
                            "set cbtics font ',11' tc rgb 'black'\nset cblabel \"{}\" font ',12' "
                            "tc rgb 'black'\n",
                            1.0 - (bar - 12) / width, 0.25, 16 / width, 0.5, escaped(colour_label))
                      : std::string("unset colorbox\n");
        script += fmt::format(
            "plot '{0}.dat' index {1} using 1:2:({2:.5g}):3 with circles fc palette{3}\n", name,
            points, 0.42 * e.spacing, lines);
    }
    script += "unset multiplot\n";
    return gnuplot::draw(folder, name, script, data);
}

}  // namespace spam

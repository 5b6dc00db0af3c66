// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnuplot_script.hpp"
#include "panel_grid.hpp"
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace spam {
namespace {

using gnuplot::escaped;

constexpr double side = 340.0, bar = 126.0, top = 50.0;  // of a frame, of the colour bar, the title
constexpr double gap = 6.0;                              // around a frame
constexpr double title_share = 26.0;                     // of a frame's height

/// What all frames have in common.
struct Shared : gnuplot::Extent {
    double low = HUGE_VAL, high = -HUGE_VAL;
    double spacing = 0.0;  ///< a particle is drawn about as wide as it has room

    /// The longer side of a frame is `side`; the shorter one has at least a third of that.
    gnuplot::Size frame() const {
        return {side * std::max(width() / across(), 0.34),
                side * std::max(height() / across(), 0.34) + title_share};
    }
};

/// Median over (at most 200 of) the particles of the distance to the nearest other one.
double typical_spacing(const Points<2>& position) {
    std::vector<double> nearest;
    const Eigen::Index n = position.cols(), stride = std::max<Eigen::Index>(1, n / 200);
    for (Eigen::Index i = 0; i < n; i += stride) {
        double least = HUGE_VAL;
        for (Eigen::Index j = 0; j < n; ++j)
            if (j != i) least = std::min(least, (position.col(i) - position.col(j)).squaredNorm());
        if (std::isfinite(least)) nearest.push_back(std::sqrt(least));
    }
    if (nearest.empty()) return 0.0;
    const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
    std::nth_element(nearest.begin(), middle, nearest.end());
    return *middle;
}

Shared shared_by(const std::vector<ConfigurationPanel>& panels) {
    Shared e;
    for (const auto& panel : panels) {
        e.include(panel.position);
        for (const auto& outline : panel.outlines) e.include(outline);
        for (const double c : panel.colour) {
            e.low = std::min(e.low, c);
            e.high = std::max(e.high, c);
        }
        e.spacing = std::max(e.spacing, typical_spacing(panel.position));
    }
    if (e.empty()) e.x[0] = e.x[1] = e.y[0] = e.y[1] = 0.0;
    // So close to each other that their colours would be one.
    if (!(e.high - e.low > 1e-9 * std::max(std::abs(e.low), std::abs(e.high))))
        e.high = e.low + std::max(1.0, 1e-3 * std::abs(e.low));
    // A margin all around, and the same scale both ways whatever the frame's shape.
    e.add_margin(std::max({0.06 * e.across(), 0.6 * e.spacing, 1e-12}));
    e.widen(0.34 * e.across());
    return e;
}

/// Each sign with its own colours, whatever the range of the other.
std::string about_zero(const Shared& e) {
    return fmt::format(
        "set palette defined ({0:g} '#8c2d04', {1:g} '#e6550d', {4:g} '#fdae6b', 0 '#9ecae1', {2:g} "
        "'#2171b5', {3:g} '#08306b')\n",
        e.low, 0.5 * e.low, 0.5 * e.high, e.high, 1e-6 * e.low);
}

std::string particle_block(const ConfigurationPanel& panel) {
    std::string block;
    for (Eigen::Index i = 0; i < panel.position.cols(); ++i)
        block += fmt::format("{:.8g} {:.8g} {:.8g}\n", panel.position(0, i), panel.position(1, i),
                             panel.colour[static_cast<std::size_t>(i)]);
    return block + "\n\n";
}

/// Elements, those of about the same colour in one block each, which gnuplot fills at once; then the lines around
/// all of them. `block`: the number of the next one. Returns what to plot.
std::string element_blocks(const ConfigurationPanel& panel, const Shared& e, std::string_view name,
                           std::string& data, int& block) {
    constexpr int tones = 64;
    std::map<int, std::string> of_tone;
    std::string lines, plot;
    for (std::size_t k = 0; k < panel.elements.size(); ++k) {
        std::string corners;
        for (std::size_t c = 0; c < 5; ++c) {
            const auto i = static_cast<Eigen::Index>(panel.elements[k][c % 4]);
            corners += fmt::format("{:.8g} {:.8g}\n", panel.position(0, i), panel.position(1, i));
        }
        const double part = (panel.colour[k] - e.low) / (e.high - e.low);
        of_tone[static_cast<int>(std::lround(part * tones))] += corners + "\n";
        lines += corners + "\n";
    }
    for (const auto& [tone, elements] : of_tone) {
        data += elements + "\n";
        plot += fmt::format("'{}.dat' index {} with filledcurves closed fc palette cb {:.6g}, ",
                            name, block++, e.low + tone * (e.high - e.low) / tones);
    }
    data += lines + "\n";
    // Lines would hide elements of a few pixels.
    const double pixels = e.spacing * side / e.across();
    return plot + fmt::format("'{}.dat' index {} with lines lw {} lc rgb '#333333'", name, block++,
                              pixels > 5.0 ? 0.4 : 0.15);
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
                         std::string_view colour_label, ColourScale scale) {
    Shared e = shared_by(panels);
    if (scale == ColourScale::about_zero) {
        e.low = std::min(e.low, -1e-3 * (e.high - e.low));
        e.high = std::max(e.high, -1e-3 * e.low);
    }
    const gnuplot::Size frame = e.frame();
    gnuplot::PanelGrid grid(panels.size(), columns, frame, {{gap, gap, gap, gap}},
                            {.right = bar, .top = top});
    grid.grow_to(title, gap);
    const gnuplot::Frame last = grid.frame(std::min(panels.size(), grid.columns()) - 1);
    const double bar_at = last.right() + gap + 12.0;
    const double title_room = e.height() * title_share / (frame.height - title_share);

    std::string data, script = gnuplot::preamble(name, grid.width(), grid.height());
    script += scale == ColourScale::about_zero ? about_zero(e) : std::string(gnuplot::palette);
    script += fmt::format(
        "set multiplot title \"{}\" font ',15' offset 0,-0.2\n"
        "set cbrange [{:.12g}:{:.12g}]\nset xrange [{:.12g}:{:.12g}]\nset yrange [{:.12g}:{:.12g}]\n"
        "unset tics\nunset key\nset border lc rgb '#bbbbbb'\nset style fill solid 1 noborder\n",
        escaped(title), e.low, e.high, e.x[0], e.x[1], e.y[0], e.y[1] + title_room);
    int block = 0;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const auto& panel = panels[k];
        std::string lines;
        if (panel.elements.empty()) {
            data += particle_block(panel);
            const bool solid = panel.diameter > 0.0;
            lines = fmt::format("'{}.dat' index {} using 1:2:({:.5g}):3 with circles fc palette{}",
                                name, block++, solid ? 0.5 * panel.diameter : 0.46 * e.spacing,
                                solid ? " fs solid 1 border -1" : "");
        } else {
            lines = element_blocks(panel, e, name, data, block);
        }
        for (const auto& outline : panel.outlines) {
            data += outline_block(outline);
            lines += fmt::format(", '{}.dat' index {} with lines lw 1.2 lc rgb '#333333'", name,
                                 block++);
        }
        script += grid.place(k);
        script += fmt::format("set label 1 \"{}\" at graph 0.5,{:.5f} center font ',12'\n",
                              escaped(panel.title), 1.0 - 0.55 * title_share / frame.height);
        script +=
            k == 0 ? fmt::format(
                         "set colorbox user origin {:.5f},{:.5f} size {:.5f},{:.5f}\n"
                         "set cbtics font ',11' tc rgb 'black'\nset cblabel \"{}\" font ',12' "
                         "tc rgb 'black'\n",
                         bar_at / grid.width(), 0.25, 16 / grid.width(), 0.5, escaped(colour_label))
                   : std::string("unset colorbox\n");
        script += fmt::format("plot {}\n", lines);
    }
    script += "unset multiplot\n";
    return gnuplot::draw(folder, name, script, data);
}

}  // namespace spam

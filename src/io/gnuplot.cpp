// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/io/gnuplot.hpp>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

extern char** environ;

namespace spam {
namespace {

/// Text inside double quotes of an enhanced-mode gnuplot string.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '_' || c == '^' || c == '{' || c == '}' || c == '@' || c == '&' || c == '~')
            out += "\\\\";
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

/// Runs gnuplot on <name>.gp inside the folder; false when it is missing or fails.
bool run_gnuplot(const RunFolder& folder, std::string_view name) {
    const std::string script = fmt::format("{}.gp", name);
    std::string command = "cd -- \"$1\" && exec gnuplot \"$2\" >/dev/null 2>\"$2.err\"";
    std::string shell = "sh", flag = "-c", self = "plot", path = folder.path().string(),
                file = script;
    char* argv[] = {shell.data(), flag.data(), command.data(), self.data(),
                    path.data(),  file.data(), nullptr};
    pid_t pid = 0;
    if (posix_spawnp(&pid, "sh", nullptr, nullptr, argv, environ) != 0) return false;
    int status = 0;
    if (waitpid(pid, &status, 0) != pid) return false;
    const bool drawn = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    std::error_code ignored;
    if (drawn) std::filesystem::remove(folder / (script + ".err"), ignored);
    return drawn;
}

constexpr std::string_view preamble =
    "# Draw again with: gnuplot {0}.gp\n"
    "set terminal pngcairo size {1},{2} font 'Sans,{3}' background rgb 'white'\n"
    "set output '{0}.png'\n"
    "set encoding utf8\n";

// Distinct without colour vision, from dark to light.
constexpr std::string_view line_styles =
    "set style line 1 lw 2.5 lc rgb '#000000'\n"
    "set style line 2 lw 2.5 lc rgb '#d55e00'\n"
    "set style line 3 lw 2.5 lc rgb '#0072b2'\n"
    "set style line 4 lw 2.5 lc rgb '#009e73' dt 2\n"
    "set style line 5 lw 2.5 lc rgb '#cc79a7'\n"
    "set style line 6 lw 2.5 lc rgb '#e69f00'\n";

}  // namespace

namespace {

/// Curves with a colour of their own, and so a place in the key.
std::vector<std::string> key_titles(const CurvePanel& panel) {
    std::vector<std::string> titles;
    for (const Curve& curve : panel.curves)
        if (curve.like == 0) titles.push_back(curve.title);
    return titles;
}

bool same_titles(const std::vector<CurvePanel>& panels) {
    return panels.size() > 1 &&
           std::all_of(panels.begin(), panels.end(), [&](const CurvePanel& panel) {
               return key_titles(panel) == key_titles(panels.front());
           });
}

/// One row under the whole picture: gnuplot's own key is no wider than its frame.
std::string shared_key(const CurvePanel& panel) {
    std::string key = "unset key\n";
    const auto titles = key_titles(panel);
    const auto n = static_cast<double>(titles.size());
    for (std::size_t k = 0; k < titles.size(); ++k) {
        const double x = (static_cast<double>(k) + 0.12) / n;
        key += fmt::format(
            "set arrow {0} from screen {1:.4f},0.06 to screen {2:.4f},0.06 nohead ls {0}\n"
            "set label {0} \"{3}\" at screen {4:.4f},0.06 left\n",
            k + 1, x, x + 0.028, escaped(titles[k]), x + 0.036);
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

/// How a curve is drawn and named; `style` counts those with a colour of their own.
std::string curve_style(const Curve& curve, int& style) {
    const std::string line = curve.like > 0 ? fmt::format("ls {} lw 1.6 dt (8,6)", curve.like)
                                            : fmt::format("ls {}", ++style);
    return curve.title.empty() ? line + " notitle"
                               : fmt::format("{} title \"{}\"", line, escaped(curve.title));
}

/// One curve as a block of the data file; a curve without points keeps its place in the key.
std::string curve_block(const CurvePanel& panel, const Curve& curve) {
    std::string block = fmt::format("# {}: {}\n", panel.title, curve.title);
    bool any = false;
    for (std::size_t k = 0; k < curve.x.size(); ++k) {
        const double y = panel.log_y ? std::abs(curve.y[k]) : curve.y[k];
        if (!std::isfinite(y) || (panel.log_y && y == 0.0)) continue;
        block += fmt::format("{:.10g} {:.10g}\n", curve.x[k], y);
        any = true;
    }
    return block + (any ? "\n\n" : "NaN NaN\n\n\n");
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
                 const std::vector<CurvePanel>& panels) {
    // One key for all frames where they show the same curves: under the middle of the picture.
    const bool shared = same_titles(panels);
    const double width = 620.0 * static_cast<double>(panels.size()), height = 540.0;
    std::string data, script = fmt::format(preamble, name, width, height, 13);
    script += line_styles;
    script += fmt::format("set multiplot title \"{}\" font ',15'\n", escaped(title));
    script +=
        "set grid back lt 1 lw 1 lc rgb '#e4e4e4'\nset border 3\nset tics nomirror\n"
        "set autoscale xfix\nset tmargin at screen 0.83\nset bmargin at screen 0.24\n";
    int block = 0;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const CurvePanel& panel = panels[k];
        const double left = 620.0 * static_cast<double>(k);
        script += fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n",
                              (left + 95) / width, (left + 600) / width);
        script += shared ? (k == 0 ? shared_key(panel) : std::string("unset label\nunset arrow\n"))
                         : fmt::format(
                               "set key at screen {:.5f},0.055 center horizontal samplen 2 "
                               "maxrows 2\n",
                               (left + 347) / width);
        script +=
            fmt::format("set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"{}\" offset 0.5,0\n",
                        escaped(panel.title), escaped(panel.x_label), escaped(panel.y_label));
        script += x_axis(panel);
        script += panel.log_y ? "set logscale y\nset format y '10^{%L}'\n"
                              : "unset logscale y\nset format y '%g'\n";
        std::string plots;
        int style = 0;
        for (const Curve& curve : panel.curves) {
            data += curve_block(panel, curve);
            plots += fmt::format("{} '{}.dat' index {} with lines {}", plots.empty() ? "plot" : ",",
                                 name, block++, curve_style(curve, style));
        }
        script += plots + "\n";
    }
    script += "unset multiplot\n";
    folder.write(fmt::format("{}.dat", name), data);
    folder.write(fmt::format("{}.gp", name), script);
    return run_gnuplot(folder, name);
}

bool draw_configurations(const RunFolder& folder, std::string_view name, std::string_view title,
                         const std::vector<ConfigurationPanel>& panels, std::size_t columns,
                         std::string_view colour_label) {
    columns = std::max<std::size_t>(1, std::min(columns, panels.size()));
    const std::size_t rows = (panels.size() + columns - 1) / columns;
    double reach = 1e-300, low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& panel : panels) {
        if (panel.position.cols() > 0)
            reach = std::max(reach, panel.position.cwiseAbs().maxCoeff());
        for (const double c : panel.colour) {
            low = std::min(low, c);
            high = std::max(high, c);
        }
    }
    if (!(high > low)) high = low + 1.0;
    const double side = 340.0, bar = 90.0, top = 50.0;
    const double width = side * static_cast<double>(columns) + bar;
    const double height = side * static_cast<double>(rows) + top;

    std::string data, script = fmt::format(preamble, name, width, height, 13);
    // A particle is drawn about as wide as its share of the frame.
    double spacing = 2.0 * reach;
    for (const auto& panel : panels)
        if (panel.position.cols() > 1)
            spacing = std::min(spacing,
                               1.7 * reach / std::sqrt(static_cast<double>(panel.position.cols())));
    script += fmt::format(
        "set multiplot title \"{}\" font ',15' offset 0,-0.2\n"
        "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 "
        "'#fde725')\n"
        "set cbrange [{:g}:{:g}]\nset xrange [{:g}:{:g}]\nset yrange [{:g}:{:g}]\n"
        "unset tics\nunset key\nset border lc rgb '#bbbbbb'\nset style fill solid 1 noborder\n",
        escaped(title), low, high, -1.1 * reach, 1.1 * reach, -1.02 * reach,
        1.18 * reach);  // titles on top
    int block = 0;
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const auto& panel = panels[k];
        for (Eigen::Index i = 0; i < panel.position.cols(); ++i)
            data += fmt::format("{:.8g} {:.8g} {:.8g}\n", panel.position(0, i),
                                panel.position(1, i), panel.colour[static_cast<std::size_t>(i)]);
        data += "\n\n";
        const int points = block++;
        std::string lines;
        for (const auto& outline : panel.outlines) {
            for (Eigen::Index i = 0; i <= outline.cols(); ++i)
                data += fmt::format("{:.8g} {:.8g}\n", outline(0, i % outline.cols()),
                                    outline(1, i % outline.cols()));
            data += "\n\n";
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
            "set label 1 \"{}\" at graph 0.5,0.957 center font ',12'\n",
            left + 6 / width, left + (side - 6) / width, bottom + 6 / height,
            bottom + (side - 6) / height, escaped(panel.title));
        script += k == 0
                      ? fmt::format(
                            "set colorbox user origin {:.5f},{:.5f} size {:.5f},{:.5f}\n"
                            "set cbtics font ',11'\nset cblabel \"{}\" font ',12'\n",
                            1.0 - (bar - 8) / width, 0.25, 16 / width, 0.5, escaped(colour_label))
                      : std::string("unset colorbox\n");
        script += fmt::format(
            "plot '{0}.dat' index {1} using 1:2:({2:.5g}):3 with circles fc palette{3}\n", name,
            points, 0.42 * spacing, lines);
    }
    script += "unset multiplot\n";
    folder.write(fmt::format("{}.dat", name), data);
    folder.write(fmt::format("{}.gp", name), script);
    return run_gnuplot(folder, name);
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "column.hpp"
#include <spam/picture/draw.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace water_column {
namespace {

/// A column of the history by the width, against time by the width, so far as all columns have come.
Curve scaled(const FluidColumn& column, const RunRecord& run, const char* name, double until) {
    Curve curve{fmt::format("{} particles", column.particles()), run.history.column("t"),
                run.history.column(name)};
    for (double& t : curve.x) t /= column.width;
    for (double& value : curve.y) value /= column.width;
    while (!curve.x.empty() && curve.x.back() > until * (1.0 + 1e-9)) {
        curve.x.pop_back();
        curve.y.pop_back();
    }
    return curve;
}

void draw_motion(Session& session, const std::vector<FluidColumn>& columns,
                 const std::vector<RunRecord>& runs) {
    std::vector<CurvePanel> panels{{"front", "t / W", "x / W", false, {}},
                                   {"height at the wall", "t / W", "y / W", false, {}}};
    double until = runs[1].history.last("t") / columns[0].width;
    for (std::size_t k = 1; 2 * k + 1 < runs.size(); ++k)
        until = std::min(until, runs[2 * k + 1].history.last("t") / columns[k].width);
    for (std::size_t k = 0; 2 * k + 1 < runs.size(); ++k) {
        panels[0].curves.push_back(scaled(columns[k], runs[2 * k + 1], "front", until));
        panels[1].curves.push_back(scaled(columns[k], runs[2 * k + 1], "height", until));
    }
    if (is_martin_and_moyce(columns[0])) {
        Curve water{.title = "water, Martin and Moyce 1952",
                    .x = {},
                    .y = {},
                    .mark = Mark::points,
                    .style = 5};
        for (const Measured& one : martin_and_moyce()) {
            if (scaled_time(columns[0], one.T) > until) continue;
            water.x.push_back(scaled_time(columns[0], one.T));
            water.y.push_back(one.Z);
        }
        panels[0].curves.push_back(water);
    }
    session.note_drawn(
        draw_curves(session.plots_folder(), "motion",
                    fmt::format("Collapse of a column, {} times as high as wide",
                                static_cast<double>(columns[0].rows) / columns[0].width),
                    panels));
}

/// Densities of the columns at rest, against the depth below the surface that their mass has by the formula.
void draw_profiles(Session& session, const std::vector<FluidColumn>& columns,
                   const std::vector<RunRecord>& runs) {
    CurvePanel densities{"", "depth / W", "density", false, {}},
        differences{"", "depth / W", "difference, %", false, {}};
    const FluidColumn& first = columns.front();
    const double deepest = hydrostatic_depth(first.g, first.rows);
    Curve formula{.title = "(2 + √(1 + 6 g d)) / 3", .x = {}, .y = {}}, zero = formula;
    for (int k = 0; k <= 200; ++k) {
        formula.x.push_back(deepest * k / 200.0 / first.width);
        formula.y.push_back(hydrostatic_density(first.g, deepest * k / 200.0));
    }
    zero.x = formula.x;
    zero.y.assign(formula.x.size(), 0.0);
    densities.curves.push_back(formula);
    differences.curves.push_back(zero);
    for (std::size_t k = 0; 2 * k < runs.size(); ++k) {
        Curve density{.title = fmt::format("{} particles", columns[k].particles()),
                      .x = {},
                      .y = {},
                      .mark = Mark::points,
                      .style = static_cast<int>(k) + 2},
            difference = density;
        const double surface = hydrostatic_depth(columns[k].g, columns[k].rows);
        for (const Slab& slab : slabs_of(columns[k], runs[2 * k].y)) {
            const double depth = surface - slab.y;
            density.x.push_back(depth / columns[k].width);
            density.y.push_back(slab.density);
            if (depth < columns[k].width / 6.0) continue;  // the surface would hide all others
            difference.x.push_back(depth / columns[k].width);
            difference.y.push_back(100.0 *
                                   (slab.density / hydrostatic_density(columns[k].g, depth) - 1.0));
        }
        densities.curves.push_back(density);
        differences.curves.push_back(difference);
    }
    session.note_drawn(draw_curves(session.plots_folder(), "profile", "The column at rest",
                                   {densities, differences}));
}

/// No more than at the floor at rest, so that a few particles do not take the colours from the others.
std::vector<double> pressures(const Parameters& p, const FluidColumn& column,
                              const NearestState<2>& state) {
    std::vector<double> y(column.released->layout().size(), 0.0);
    State<2>(column.released->layout(), y).position() = state.position;
    auto all = column.released->density(y);
    const auto law = law_of(p);
    for (double& rho : all) rho = std::min(law.pressure(rho, 0.0), p.gravity);
    return all;
}

/// Of the widest column that has been released.
void draw_particles(Session& session, const Parameters& p, const FluidColumn& column) {
    double across = 0.0, up = 0.0;
    for (const auto& state : column.drawn)
        if (state.there()) {
            across = std::max(across, state.position.row(0).maxCoeff());
            up = std::max(up, state.position.row(1).maxCoeff());
        }
    Points<2> walls(2, 4);  // there and back: outlines are closed
    walls << 0.0, 0.0, across, 0.0, up, 0.0, 0.0, 0.0;
    std::vector<ConfigurationPanel> panels;
    for (const auto& state : column.drawn)
        if (state.there())
            panels.push_back(
                {state.t == 0.0 ? "t = 0" : fmt::format("t = {:.3g} W", state.t / column.width),
                 state.position,
                 pressures(p, column, state),
                 {walls}});
    if (panels.empty()) return;
    session.note_drawn(draw_configurations(
        session.plots_folder(), "configurations",
        fmt::format("Collapse of {} particles; warm colours: tension", column.particles()), panels,
        2, "pressure", ColourScale::about_zero));
}

}  // namespace

void draw(Session& session, const Parameters& p, const std::vector<FluidColumn>& columns,
          const std::vector<RunRecord>& runs) {
    if (runs.empty()) return;
    draw_profiles(session, columns, runs);
    if (runs.size() < 2) return;
    draw_motion(session, columns, runs);
    draw_particles(session, p, columns[runs.size() / 2 - 1]);
}

}  // namespace water_column

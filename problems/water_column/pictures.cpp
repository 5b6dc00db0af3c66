// SPDX-License-Identifier: GPL-3.0-or-later
#include "column.hpp"

namespace water_column {
namespace {

/// A column of the history by the width, against time by the width, so far as all columns have come.
Curve scaled(const FluidColumn& column, const RunRecord& run, const char* name, double until) {
    Curve curve{column.words(), divided(run.history.column("t"), column.width),
                divided(run.history.column(name), column.width)};
    while (!curve.x.empty() && curve.x.back() > until * (1.0 + 1e-9)) {
        curve.x.pop_back();
        curve.y.pop_back();
    }
    return curve;
}

void draw_motion(Session& session, const std::vector<Computed>& columns) {
    std::vector<CurvePanel> panels{{"front", "t / W", "x / W", false, {}},
                                   {"height at the wall", "t / W", "y / W", false, {}}};
    const FluidColumn& first = *columns[0].column;
    double until = columns[0].collapse->history.last("t") / first.width;
    for (const auto& [column, rest, collapse] : columns)
        if (collapse) until = std::min(until, collapse->history.last("t") / column->width);
    for (const auto& [column, rest, collapse] : columns) {
        if (!collapse) continue;
        panels[0].curves.push_back(scaled(*column, *collapse, "front", until));
        panels[1].curves.push_back(scaled(*column, *collapse, "height", until));
    }
    if (is_martin_and_moyce(first)) {
        Curve water{"water, Martin and Moyce 1952", {}, {}, Mark::points, 5};
        for (const Measured& one : martin_and_moyce()) {
            if (scaled_time(first, one.T) > until) continue;
            add_point(water, scaled_time(first, one.T), one.Z);
        }
        panels[0].curves.push_back(water);
    }
    draw_curves(session, "motion",
                fmt::format("Collapse of a column, {} times as high as wide",
                            static_cast<double>(first.rows) / first.width),
                panels);
}

/// Densities of the columns at rest, against the depth below the surface that their mass has by the formula.
void draw_profiles(Session& session, const std::vector<Computed>& columns) {
    CurvePanel densities{"", "depth / W", "density", false, {}},
        differences{"", "depth / W", "difference, %", false, {}};
    const FluidColumn& first = *columns[0].column;
    const double deepest = hydrostatic_depth(first.g, first.rows);
    Curve formula{.title = "(2 + √(1 + 6 g d)) / 3", .x = {}, .y = {}}, zero = formula;
    for (int k = 0; k <= 200; ++k)
        add_point(formula, deepest * k / 200.0 / first.width,
                  hydrostatic_density(first.g, deepest * k / 200.0));
    zero.x = formula.x;
    zero.y.assign(formula.x.size(), 0.0);
    densities.curves.push_back(formula);
    differences.curves.push_back(zero);
    for (int style = 2; const auto& [column, rest, collapse] : columns) {
        Curve density{column->words(), {}, {}, Mark::points, style++}, difference = density;
        const double surface = hydrostatic_depth(column->g, column->rows);
        for (const Slab& slab : slabs_of(*column, rest->y)) {
            const double depth = surface - slab.y;
            add_point(density, depth / column->width, slab.density);
            if (depth < column->width / 6.0) continue;  // the surface would hide all others
            add_point(difference, depth / column->width,
                      100.0 * (slab.density / hydrostatic_density(column->g, depth) - 1.0));
        }
        densities.curves.push_back(density);
        differences.curves.push_back(difference);
    }
    draw_curves(session, "profile", "The column at rest", {densities, differences});
}

/// No more than at the floor at rest, so that a few particles do not take the colours from the others.
std::vector<double> pressures(const Parameters& p, const FluidColumn& column,
                              const NearestState<2>& state) {
    std::vector<double> y(column.released->layout().size(), 0.0);
    State<2>(column.released->layout(), y).position() = state.position;
    auto all = pressures_of(p, *column.released, y);
    for (double& P : all) P = std::min(P, p.gravity);
    return all;
}

Points<2> walls_of(const std::vector<ConfigurationPanel>& panels) {
    Point<2> most = Point<2>::Zero();
    for (const auto& panel : panels) most = most.cwiseMax(panel.position.rowwise().maxCoeff());
    Points<2> walls(2, 4);  // there and back: outlines are closed
    walls << 0.0, 0.0, most.x(), 0.0, most.y(), 0.0, 0.0, 0.0;
    return walls;
}

ConfigurationPanel panel_of(const Parameters& p, const FluidColumn& column,
                            const NearestState<2>& state, const std::string& title) {
    const auto elements = column.released->quadrilaterals();
    return {
        title, state.position, pressures(p, column, state), {}, {elements.begin(), elements.end()}};
}

void draw_panels(Session& session, const char* name, const std::string& title,
                 std::vector<ConfigurationPanel> panels, std::size_t columns) {
    if (panels.empty()) return;
    const Points<2> walls = walls_of(panels);
    for (auto& panel : panels) panel.outlines.push_back(walls);
    draw_configurations(session, name, title + "; warm colours: tension", panels, columns,
                        "pressure", ColourScale::about_zero);
}

/// Of the widest column that has been released.
void draw_particles(Session& session, const Parameters& p, const FluidColumn& column) {
    std::vector<ConfigurationPanel> panels;
    for (const auto& state : column.drawn)
        if (state.there())
            panels.push_back(panel_of(
                p, column, state,
                state.t == 0.0 ? "t = 0" : fmt::format("t = {:.3g} W", state.t / column.width)));
    draw_panels(session, "configurations", "Collapse of " + column.words(), std::move(panels), 2);
}

/// At rest, and at the times at which they are compared: one column above the other.
void draw_beside(Session& session, const Parameters& p, const std::vector<Computed>& columns) {
    constexpr std::size_t times = 1 + std::size(compared_times);
    std::vector<ConfigurationPanel> panels;
    std::string words;
    for (const auto& [column, rest, collapse] : columns) {
        words += (words.empty() ? "" : " and ") + column->words();
        for (std::size_t k = 0; k < times; ++k) {
            const auto& state = column->drawn[k];
            if (!state.there()) return;
            panels.push_back(
                panel_of(p, *column, state,
                         fmt::format("{}, t = {:g}",
                                     column->of_elements() ? "elements" : "particles", state.t)));
        }
    }
    draw_panels(session, "beside", "Collapse of " + words, std::move(panels), times);
}

}  // namespace

void draw(Session& session, const Parameters& p, const std::vector<Computed>& all) {
    std::vector<Computed> columns = all;
    std::erase_if(columns, [](const Computed& one) { return one.column->sample > 0; });
    if (columns.empty()) return;
    draw_profiles(session, columns);
    const auto released = std::find_if(columns.rbegin(), columns.rend(),
                                       [](const Computed& one) { return one.collapse; });
    if (released == columns.rend()) return;
    draw_motion(session, columns);
    if (p.model == ColumnOf::both)
        draw_beside(session, p, columns);
    else
        draw_particles(session, p, *released->column);
}

}  // namespace water_column

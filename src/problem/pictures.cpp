// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/problem/pictures.hpp>

namespace spam {

void draw_curves(Session& session, std::string_view name, std::string_view title,
                 const std::vector<CurvePanel>& panels, std::size_t columns) {
    session.note_drawn(draw_curves(session.plots_folder(), name, title, panels, columns));
}

void draw_log_log(Session& session, std::string_view name, const LogLogPicture& picture) {
    session.note_drawn(draw_log_log(session.plots_folder(), name, picture));
}

void draw_configurations(Session& session, std::string_view name, std::string_view title,
                         const std::vector<ConfigurationPanel>& panels, std::size_t columns,
                         std::string_view colour_label, ColourScale scale) {
    // A run that ends early has one state for several of the times that were wanted: it is drawn once.
    std::vector<ConfigurationPanel> different;
    for (const auto& panel : panels)
        if (different.empty() || panel.title != different.back().title ||
            panel.position.cols() != different.back().position.cols() ||
            panel.position != different.back().position || panel.colour != different.back().colour)
            different.push_back(panel);
    session.note_drawn(draw_configurations(session.plots_folder(), name, title, different, columns,
                                           colour_label, scale));
}

void draw_contours(Session& session, std::string_view name, std::string_view title,
                   const std::vector<ContourPanel>& panels, std::size_t columns,
                   const ContourRoom& room) {
    session.note_drawn(draw_contours(session.plots_folder(), name, title, panels, columns, room));
}

void draw_paths(Session& session, std::string_view name, std::string_view title,
                const std::vector<PathPanel>& panels, std::size_t columns) {
    session.note_drawn(draw_paths(session.plots_folder(), name, title, panels, columns));
}

void draw_bars(Session& session, std::string_view name, std::string_view title,
               const BarChart& chart) {
    session.note_drawn(draw_bars(session.plots_folder(), name, title, chart));
}

void draw_heat_map(Session& session, std::string_view name, std::string_view title,
                   const HeatMap& map) {
    session.note_drawn(draw_heat_map(session.plots_folder(), name, title, map));
}

CurvePanel frame(std::string title, std::string x_label, std::string y_label, bool log_y) {
    return {std::move(title), std::move(x_label), std::move(y_label), log_y, {}};
}

Curve over_time(std::string title, const History& h, std::string_view column) {
    return {std::move(title), h.column("t"), h.column(column)};
}

CurvePanel over_time(std::string title, const History& h, std::string y_label,
                     const std::vector<std::pair<std::string, std::string>>& columns, bool log_y) {
    CurvePanel panel = frame(std::move(title), "t", std::move(y_label), log_y);
    for (const auto& [name, column] : columns) panel.curves.push_back(over_time(name, h, column));
    return panel;
}

Curve graph(std::string title, double from, double to, int pieces,
            const std::function<double(double x)>& y, int style) {
    Curve curve{std::move(title), {}, {}, Mark::line, style};
    for (int k = 0; k <= pieces; ++k) {
        const double x = from + (to - from) * k / pieces;
        add_point(curve, x, y(x));
    }
    return curve;
}

std::vector<double> divided(std::vector<double> values, double unit) {
    for (double& value : values) value /= unit;
    return values;
}

Points<2> rectangle(const Point<2>& low, const Point<2>& high) {
    return Points<2>{{low.x(), high.x(), high.x(), low.x()},
                     {low.y(), low.y(), high.y(), high.y()}};
}

}  // namespace spam

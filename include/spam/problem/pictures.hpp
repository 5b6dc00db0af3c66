// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/diagnostics/history.hpp>
#include <spam/picture/draw.hpp>
#include <spam/problem/session.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spam {

// The pictures of picture/draw.hpp in the session's folder of pictures, which says once what could not be
// drawn. Precondition of all: session.plots().

void draw_curves(Session& session, std::string_view name, std::string_view title,
                 const std::vector<CurvePanel>& panels, std::size_t columns = 0);
void draw_log_log(Session& session, std::string_view name, const LogLogPicture& picture);
void draw_configurations(Session& session, std::string_view name, std::string_view title,
                         const std::vector<ConfigurationPanel>& panels, std::size_t columns,
                         std::string_view colour_label,
                         ColourScale scale = ColourScale::dark_to_light);
void draw_contours(Session& session, std::string_view name, std::string_view title,
                   const std::vector<ContourPanel>& panels, std::size_t columns,
                   const ContourRoom& room);
void draw_paths(Session& session, std::string_view name, std::string_view title,
                const std::vector<PathPanel>& panels, std::size_t columns);
void draw_bars(Session& session, std::string_view name, std::string_view title,
               const BarChart& chart);
void draw_heat_map(Session& session, std::string_view name, std::string_view title,
                   const HeatMap& map);

/// An empty frame, for curves that are added to it.
CurvePanel frame(std::string title, std::string x_label, std::string y_label, bool log_y = false);

/// A column of a history against t.
Curve over_time(std::string title, const History& h, std::string_view column);
/// A frame of several: title and column of each.
CurvePanel over_time(std::string title, const History& h, std::string y_label,
                     const std::vector<std::pair<std::string, std::string>>& columns,
                     bool log_y = false);

/// y(x) at pieces + 1 places from `from` to `to`.
Curve graph(std::string title, double from, double to, int pieces,
            const std::function<double(double x)>& y, int style = 0);

/// One more point of a curve, between axes of either kind.
template <class AnyCurve>
void add_point(AnyCurve& curve, double x, double y) {
    curve.x.push_back(x);
    curve.y.push_back(y);
}

/// All of them by `unit`.
std::vector<double> divided(std::vector<double> values, double unit);

/// The sides of a rectangle, as an outline.
Points<2> rectangle(const Point<2>& low, const Point<2>& high);

}  // namespace spam

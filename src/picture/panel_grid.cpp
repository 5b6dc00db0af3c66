// SPDX-License-Identifier: GPL-3.0-or-later
#include "panel_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spam::gnuplot {

void Extent::include(const Points<2>& points) {
    for (const auto& point : points.colwise()) {
        x[0] = std::min(x[0], point.x());
        x[1] = std::max(x[1], point.x());
        y[0] = std::min(y[0], point.y());
        y[1] = std::max(y[1], point.y());
    }
}

void Extent::add_margin(double margin) {
    for (double* range : {x, y}) {
        range[0] -= margin;
        range[1] += margin;
    }
}

void Extent::widen(double least) {
    for (double* range : {x, y}) {
        const double more = std::max(0.0, 0.5 * (least - (range[1] - range[0])));
        range[0] -= more;
        range[1] += more;
    }
}

PanelGrid::PanelGrid(std::size_t panels, std::size_t most_columns, Size frame,
                     std::vector<Room> around, Room outside)
    : columns_(std::max<std::size_t>(1, std::min(most_columns, panels))),
      frame_(frame),
      around_(std::move(around)),
      outside_(outside) {
    const std::size_t rows = (panels + columns_ - 1) / columns_;
    around_.resize(std::max<std::size_t>(1, rows), around_.front());
    const Room& sides = around_.front();
    size_.width = outside_.left + outside_.right +
                  static_cast<double>(columns_) * (sides.left + frame_.width + sides.right);
    double down = outside_.top;
    for (std::size_t row = 0; row < rows; ++row) {
        down += around_[row].top + frame_.height;
        bottom_.push_back(down);
        down += around_[row].bottom;
    }
    size_.height = down + outside_.bottom;
    for (double& bottom : bottom_) bottom = size_.height - bottom;
}

void PanelGrid::grow_to(std::string_view title, double margin) {
    const double width =
        10.6 * static_cast<double>(title.size()) + 2.0 * margin;  // of a letter: 10.6
    outside_.left += 0.5 * std::max(0.0, width - size_.width);
    size_.width = std::max(size_.width, width);
}

void PanelGrid::make_even() {
    size_.width = 2.0 * std::ceil(0.5 * size_.width);
    const double higher = 2.0 * std::ceil(0.5 * size_.height) - size_.height;
    size_.height += higher;
    for (double& bottom : bottom_) bottom += higher;
}

Frame PanelGrid::frame(std::size_t panel) const {
    const Room& sides = around_.front();
    const double column = sides.left + frame_.width + sides.right;
    return {outside_.left + static_cast<double>(panel % columns_) * column + sides.left,
            bottom_[panel / columns_], frame_};
}

std::string PanelGrid::at(double x, double y) const {
    return fmt::format("{:.6f},{:.6f}", x / size_.width, y / size_.height);
}

std::string PanelGrid::place(std::size_t panel) const { return margins(frame(panel), size_); }

std::string margins(const Frame& frame, const Size& picture) {
    return fmt::format(
        "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n"
        "set bmargin at screen {:.6f}\nset tmargin at screen {:.6f}\n",
        frame.left / picture.width, frame.right() / picture.width, frame.bottom / picture.height,
        frame.top() / picture.height);
}

}  // namespace spam::gnuplot

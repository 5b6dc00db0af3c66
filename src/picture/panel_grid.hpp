// SPDX-License-Identifier: GPL-3.0-or-later
// Where the panels of a picture lie, for every kind of picture. Lengths are pixels, y upwards from the lower edge.
#pragma once

#include <spam/core/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace spam::gnuplot {

/// Room around a frame or around all panels.
struct Room {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
};

struct Size {
    double width, height;
};

/// What a panel draws in: the rectangle between its axes.
struct Frame {
    double left, bottom;
    Size size;
    double right() const { return left + size.width; }
    double top() const { return bottom + size.height; }
};

/// The range of what several frames show, the same in all of them.
struct Extent {
    double x[2] = {HUGE_VAL, -HUGE_VAL}, y[2] = {HUGE_VAL, -HUGE_VAL};

    void include(const Points<2>& points);
    bool empty() const { return !(x[1] >= x[0]); }
    double width() const { return x[1] - x[0]; }
    double height() const { return y[1] - y[0]; }
    double across() const { return std::max(width(), height()); }
    /// On all sides.
    void add_margin(double margin);
    /// No side shorter than that.
    void widen(double least);
};

/// Panels row by row from above, frames all of one size.
class PanelGrid {
  public:
    /// `around`: each frame, one for each row where rows differ, or one for all; `outside`: all panels.
    PanelGrid(std::size_t panels, std::size_t most_columns, Size frame, std::vector<Room> around,
              Room outside = {});

    std::size_t columns() const { return columns_; }
    std::size_t rows() const { return bottom_.size(); }
    double width() const { return size_.width; }
    double height() const { return size_.height; }

    /// A picture wide enough for its title, the panels in its middle; and of whole even numbers of pixels, as films
    /// want them.
    void grow_to(std::string_view title, double margin);
    void make_even();

    Frame frame(std::size_t panel) const;
    /// gnuplot's words for a place, an x and a y: "0.25,0.75", "0.25" and "0.75" of the picture.
    std::string at(double x, double y) const;
    /// gnuplot's commands that put the next plot into the frame of that panel.
    std::string place(std::size_t panel) const;

  private:
    std::size_t columns_;
    Size frame_;
    std::vector<Room> around_;
    Room outside_;
    Size size_{};
    std::vector<double> bottom_;  ///< of the frames of each row
};

/// gnuplot's commands that put the next plot into a frame of a picture.
std::string margins(const Frame& frame, const Size& picture);

}  // namespace spam::gnuplot

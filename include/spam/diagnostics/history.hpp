// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/archive.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// A table of numbers against time: named columns, one row per output time. Column 0 is t.
class History {
  public:
    /// Of these columns, without rows; the first one is t.
    explicit History(std::vector<std::string> names) : names_(std::move(names)) {}

    /// Precondition: one value per column.
    void add(std::vector<double> row);

    /// Of the columns, in order.
    const std::vector<std::string>& names() const { return names_; }
    /// Rows in the order of time, one number per column.
    const std::vector<std::vector<double>>& rows() const { return rows_; }
    /// Whether there is a column of this name.
    bool has(std::string_view name) const;

    /// Names included. Throws InputError where those read are others.
    void remember(Archive& archive);

    /// Values of one column. Throws std::out_of_range naming an unknown column.
    std::vector<double> column(std::string_view name) const;
    /// In the first row. Here and below: std::out_of_range names an unknown column.
    double first(std::string_view name) const;
    /// In the last row.
    double last(std::string_view name) const;
    /// Over all rows.
    double largest(std::string_view name) const;
    /// Over all rows.
    double smallest(std::string_view name) const;

    /// |last - first| / |first|
    double relative_drift(std::string_view name) const;
    /// max over rows of |value - first|
    double largest_change(std::string_view name) const;
    /// (last - value then) / (end - then), from `part` of the last row's time on: the mean force, say, of an impulse.
    double mean_rate(std::string_view name, double part) const;
    /// Value at time t, linear between rows, constant outside.
    double at(double t, std::string_view name) const;

  private:
    std::size_t index(std::string_view name) const;

    std::vector<std::string> names_;
    std::vector<std::vector<double>> rows_;
    /// Of each column so far: asked for at every row of a run.
    struct Extent {
        double largest, change;
    };
    std::vector<Extent> extents_;
};

}  // namespace spam

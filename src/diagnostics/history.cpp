// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/diagnostics/history.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace spam {

void History::add(std::vector<double> row) {
    assert(row.size() == names_.size());
    if (rows_.empty())
        for (const double value : row) extents_.push_back({value, std::abs(value - value)});
    for (std::size_t k = 0; k < row.size(); ++k) {
        Extent& extent = extents_[k];
        if (extent.largest < row[k]) extent.largest = row[k];
        const double change = rows_.empty() ? 0.0 : std::abs(row[k] - rows_.front()[k]);
        if (!(change <= extent.change) && !std::isnan(extent.change)) extent.change = change;
    }
    rows_.push_back(std::move(row));
}

void History::remember(Archive& archive) {
    std::vector<std::string> names = names_;
    auto rows = archive.reading() ? std::vector<std::vector<double>>{} : rows_;
    archive(names, rows);
    if (names != names_)
        throw InputError(fmt::format("remembered columns {}, not {}", fmt::join(names, ","),
                                     fmt::join(names_, ",")));
    if (!archive.reading()) return;
    for (const auto& row : rows)
        if (row.size() != names_.size())
            throw InputError(fmt::format("a remembered row has {} numbers for {} columns",
                                         row.size(), names_.size()));
    rows_.clear();
    extents_.clear();
    for (auto& row : rows) add(std::move(row));
}

bool History::has(std::string_view name) const {
    return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t History::index(std::string_view name) const {
    const auto it = std::find(names_.begin(), names_.end(), name);
    if (it == names_.end())
        throw std::out_of_range(
            fmt::format("history has no column '{}'; it has {}", name, fmt::join(names_, ", ")));
    return static_cast<std::size_t>(it - names_.begin());
}

std::vector<double> History::column(std::string_view name) const {
    const std::size_t k = index(name);
    std::vector<double> values;
    values.reserve(rows_.size());
    for (const auto& row : rows_) values.push_back(row[k]);
    return values;
}

double History::first(std::string_view name) const { return rows_.front()[index(name)]; }
double History::last(std::string_view name) const { return rows_.back()[index(name)]; }

double History::largest(std::string_view name) const { return extents_[index(name)].largest; }

double History::smallest(std::string_view name) const {
    const auto values = column(name);
    return *std::min_element(values.begin(), values.end());
}

double History::relative_drift(std::string_view name) const {
    return std::abs(last(name) - first(name)) / std::abs(first(name));
}

/// NaN where there was one.
double History::largest_change(std::string_view name) const { return extents_[index(name)].change; }

double History::mean_rate(std::string_view name, double part) const {
    const double until = last("t"), since = part * until;
    return (last(name) - at(since, name)) / (until - at(since, "t"));
}

double History::at(double t, std::string_view name) const {
    const std::size_t k = index(name);
    if (t <= rows_.front()[0]) return rows_.front()[k];
    for (std::size_t r = 1; r < rows_.size(); ++r) {
        const auto& a = rows_[r - 1];
        const auto& b = rows_[r];
        if (t <= b[0]) return a[k] + (b[k] - a[k]) * (t - a[0]) / (b[0] - a[0]);
    }
    return rows_.back()[k];
}

}  // namespace spam

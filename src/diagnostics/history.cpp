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
    rows_.push_back(std::move(row));
}

void History::remember(Archive& archive) {
    std::vector<std::string> names = names_;
    archive(names, rows_);
    if (names != names_)
        throw InputError(fmt::format("remembered columns {}, not {}", fmt::join(names, ","),
                                     fmt::join(names_, ",")));
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

double History::largest(std::string_view name) const {
    const auto values = column(name);
    return *std::max_element(values.begin(), values.end());
}

double History::smallest(std::string_view name) const {
    const auto values = column(name);
    return *std::min_element(values.begin(), values.end());
}

double History::relative_drift(std::string_view name) const {
    return std::abs(last(name) - first(name)) / std::abs(first(name));
}

double History::largest_change(std::string_view name) const {
    double change = 0.0;
    for (const double value : column(name)) {
        const double here = std::abs(value - first(name));
        if (!(here <= change)) change = here;  // NaN stays
        if (std::isnan(change)) break;
    }
    return change;
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

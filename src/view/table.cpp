// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.hpp"
#include "results.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <fmt/format.h>

#include <limits>

namespace spam::view {
namespace {

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (;;) {
        const std::size_t comma = line.find(',');
        cells.push_back(line.substr(0, comma));
        if (comma == line.npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

}  // namespace

Table read_table(const std::filesystem::path& path) {
    const std::string text = contents(path);
    const auto refuse = [&](std::size_t line, const std::string& reason) {
        throw InputError(fmt::format("RESULTS: {}, line {}: {}; run the problem again",
                                     one_line(path.string()), line, one_line(reason)));
    };
    Table table;
    std::string_view rest(text);
    for (std::size_t line = 1, end; (end = rest.find('\n')) != rest.npos; ++line) {
        const auto cells = cells_of(rest.substr(0, end));
        rest.remove_prefix(end + 1);
        if (line == 1) {
            table.names.assign(cells.begin(), cells.end());
            table.columns.resize(cells.size());
            if (table.names[0] != "t") refuse(line, "the first column should be t");
            continue;
        }
        if (cells.size() != table.names.size())
            refuse(line,
                   fmt::format("{} columns, and should have {}", cells.size(), table.names.size()));
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const auto value = number_in(cells[c]);
            if (!value && !cells[c].empty())
                refuse(line, fmt::format("column {}: '{}' is no number", table.names[c],
                                         cells[c].substr(0, 40)));
            table.columns[c].push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
        }
    }
    return table;
}

}  // namespace spam::view

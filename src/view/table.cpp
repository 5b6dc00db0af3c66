// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.hpp"
#include "results.hpp"
#include <spam/io/csv.hpp>

namespace spam::view {

Table read_table(const std::filesystem::path& path) {
    CsvReader rows(contents(path), path.string(),
                   {.option = "RESULTS", .remedy = "run the problem again", .whole = true});
    if (!rows.next()) return {};
    if (rows.cells().front() != "t") rows.refuse("the first column should be t");
    rows.keep_as_header();
    Table table{rows.names(), std::vector<std::vector<double>>(rows.names().size())};
    while (rows.next())
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            table.columns[c].push_back(rows.number(c));
    return table;
}

}  // namespace spam::view

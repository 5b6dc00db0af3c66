// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/io/csv.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace spam {

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& names)
    : path_(path),
      out_(path) {
    out_ << fmt::format("{}\n", fmt::join(names, ","));
    flush();
}

void CsvWriter::add(std::span<const double> row) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (k > 0) line += ',';
        if (std::isfinite(row[k])) line += fmt::format("{:.17g}", row[k]);
    }
    out_ << line << '\n';
    flush();
}

/// A row that did not fit on the disk is taken back, so that the table ends with a whole one.
void CsvWriter::flush() {
    out_.flush();
    if (out_) {
        whole_ = out_.tellp();
        return;
    }
    out_.clear();
    out_.close();
    std::error_code ignored;
    std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(whole_), ignored);
    throw OutputError(fmt::format("cannot write '{}' (disk full?)", path_.string()));
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/io/csv.hpp>

#include <fmt/format.h>

namespace spam {

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& names)
    : path_(path),
      out_(path) {
    out_ << fmt::format("{}\n", fmt::join(names, ","));
    flush();
}

void CsvWriter::add(std::span<const double> row) {
    std::string line;
    for (const double x : row) line += fmt::format("{}{:.17g}", line.empty() ? "" : ",", x);
    out_ << line << '\n';
    flush();
}

void CsvWriter::flush() {
    out_.flush();
    if (!out_) throw OutputError(fmt::format("cannot write '{}' (disk full?)", path_.string()));
}

}  // namespace spam

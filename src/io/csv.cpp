// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_descriptor.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/io/csv.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace spam {

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& names)
    : path_(path) {
    begin_file(path);
    out_.open(path);
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

std::string csv_line(const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (k > 0) line += ',';
        const bool quoted = cells[k].find_first_of(",\"") != std::string::npos;
        if (quoted) line += '"';
        for (const char c : cells[k]) {
            if (c == '"') line += '"';
            line += c == '\n' || c == '\r' ? ' ' : c;
        }
        if (quoted) line += '"';
    }
    return line + '\n';
}

std::vector<std::string> csv_cells(std::string_view line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const char c = line[k];
        if (quoted && c == '"' && k + 1 < line.size() && line[k + 1] == '"') {
            cells.back() += '"';
            ++k;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

CsvReader::CsvReader(std::string text, std::string file, CsvRules rules)
    : text_(std::move(text)),
      file_(std::move(file)),
      rules_(std::move(rules)) {}

bool CsvReader::next() {
    while (at_ < text_.size()) {
        const std::size_t end = text_.find('\n', at_);
        if (end == text_.npos && rules_.whole) return false;
        std::string line = text_.substr(at_, end == text_.npos ? end : end - at_);
        at_ = end == text_.npos ? text_.size() : end + 1;
        ++line_;
        if (line.ends_with('\r')) line.pop_back();
        if (rules_.free) {
            // "x, y", "x,y" and "x y" are two cells each; a comma too many makes an empty one.
            static constexpr std::string_view blanks = " \t\v\f\r";
            std::string words;
            for (std::size_t k = 0; k < line.size(); ++k) {
                if (blanks.find(line[k]) == blanks.npos) {
                    words += line[k];
                    continue;
                }
                const std::size_t next = std::min(line.find_first_not_of(blanks, k), line.size());
                const bool between = !words.empty() && next < line.size();
                if (between && words.back() != ',' && line[next] != ',') words += ',';
                k = next - 1;
            }
            if (words.empty() || words.front() == '#') continue;
            line = std::move(words);
        }
        cells_ = csv_cells(line);
        if (!names_.empty() && cells_.size() != names_.size())
            refuse(fmt::format("has {} cells in place of {}", cells_.size(), names_.size()));
        return true;
    }
    return false;
}

double CsvReader::number(std::size_t column) const {
    const std::string& cell = cells_.at(column);
    if (cell.empty() && !rules_.free) return std::nan("");
    if (const auto value = number_in(cell)) return *value;
    refuse(fmt::format("column {}: '{}' is no number",
                       column < names_.size() ? names_[column] : std::to_string(column + 1),
                       cell.substr(0, 40)));
}

void CsvReader::refuse(std::string_view reason) const {
    throw InputError(fmt::format("{}: '{}' line {}: {}; {}", rules_.option, one_line(file_), line_,
                                 one_line(reason), rules_.remedy));
}

}  // namespace spam

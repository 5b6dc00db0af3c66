// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// A comma-separated table with a header, 17 significant digits, every row on disk as soon as it is
/// added; a cell without a finite number is left empty. Throws OutputError when it cannot be written.
class CsvWriter {
  public:
    CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& names);
    void add(std::span<const double> row);

  private:
    void flush();
    std::filesystem::path path_;
    std::ofstream out_;
    std::streamoff whole_ = 0;  ///< bytes of whole rows on disk
};

/// Cells as a line of CSV: those with a comma or quotation marks are quoted; line ends become spaces.
std::string csv_line(const std::vector<std::string>& cells);
/// The cells of such a line, without its end.
std::vector<std::string> csv_cells(std::string_view line);

/// How a table is read, and what is said of one that cannot be.
struct CsvRules {
    std::string option;  ///< which option names the file
    std::string remedy;  ///< what to do about a table that is refused
    bool free = false;   ///< by hand: blanks separate cells too; empty lines and # ... are no rows
    bool whole = false;  ///< a last line without an end is no row: its writer was killed
};

/// A table of comma-separated cells, a line at a time. Every refusal is an InputError with option, file, line,
/// column (its name, where the table has a header that was read) and remedy.
class CsvReader {
  public:
    /// `text`: of the whole file; `file`: its name in messages.
    CsvReader(std::string text, std::string file, CsvRules rules);

    /// Goes to the next row; false where there is none.
    bool next();
    /// Makes the present row the header: names of columns, of which every later row must have as many.
    void keep_as_header() { names_ = cells_; }

    const std::vector<std::string>& names() const { return names_; }
    const std::vector<std::string>& cells() const { return cells_; }
    int line() const { return line_; }
    /// A finite number; NaN where the cell is empty and the table not by hand.
    double number(std::size_t column) const;

    [[noreturn]] void refuse(std::string_view reason) const;

  private:
    std::string text_, file_;
    CsvRules rules_;
    std::size_t at_ = 0;  ///< where the next line begins
    int line_ = 0;
    std::vector<std::string> names_, cells_;
};

}  // namespace spam

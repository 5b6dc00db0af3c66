// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
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

}  // namespace spam

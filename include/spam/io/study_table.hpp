// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/run_folder.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace spam {

/// One row of a study: its name (the first cell) and how to compute the other cells. Nothing comes
/// back where the computation was interrupted.
struct StudyTask {
    std::string name;
    std::function<std::optional<std::vector<std::string>>()> compute;
};

/// A table computed row by row over the cores. Each row is on disk (flushed to the device) as soon as
/// it is known, in NAME.part.csv, so that a study that was killed goes on where it was; there every line
/// ends with seals of its cells, so that one that was changed is found. Complete, the table becomes NAME.csv with
/// the rows in the order of the tasks.
class StudyTable {
  public:
    using Row = std::vector<std::string>;

    /// Reads what an earlier, unfinished study left there; a last line that is torn does not count.
    /// Throws InputError, and leaves the file as it is, where its columns are others or a line is not what
    /// was written.
    StudyTable(const RunFolder& folder, std::string name, std::vector<std::string> columns);

    /// Whether a study of that name was begun in the folder and not finished.
    static bool unfinished(const std::filesystem::path& folder, std::string_view name);

    std::size_t known() const { return rows_.size(); }

    /// Computes the rows that are not there, `threads` at a time; `on_row` is called in this thread
    /// with the number of rows known, and now and then without news. An exception of a task, or
    /// OutputError, ends it after the tasks under way. Returns whether all rows are there; then the
    /// table is complete on disk.
    bool run(const std::vector<StudyTask>& tasks, int threads,
             const std::function<void(std::size_t known)>& on_row);

    /// Rows known, in the order of the tasks.
    std::vector<Row> rows(const std::vector<StudyTask>& tasks) const;

  private:
    void append(const Row& row);
    Row header() const;
    void read(const std::string& line, int number);
    [[noreturn]] void refuse(int line, const std::string& why) const;
    std::filesystem::path part() const { return folder_ / (name_ + ".part.csv"); }

    RunFolder folder_;
    std::string name_;
    std::vector<std::string> columns_;
    std::map<std::string, Row> rows_;
};

/// The cell of a row under a name of `columns`, those of its table. Throws std::out_of_range for other names.
const std::string& cell_of(const StudyTable::Row& row, const std::vector<std::string>& columns,
                           std::string_view name);
/// The number in a cell of a row; NaN where it is empty. Throws InputError, naming row and cell, where it holds
/// something else.
double number_in_cell(const StudyTable::Row& row, std::size_t column);
double number_of(const StudyTable::Row& row, const std::vector<std::string>& columns,
                 std::string_view name);

}  // namespace spam

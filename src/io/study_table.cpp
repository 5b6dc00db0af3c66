// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_descriptor.hpp"
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/core/text.hpp>
#include <spam/integrate/interrupt.hpp>
#include <spam/io/csv.hpp>
#include <spam/io/study_table.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <fstream>
#include <mutex>
#include <system_error>
#include <thread>

namespace spam {

namespace {

const std::string check_column = "check";

/// Four hexadecimal digits of a cell (FNV-1a, folded): enough to find where a line was changed.
std::string seal_of(std::string_view cell) {
    std::uint32_t hash = 2166136261U;
    for (const char c : cell) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    return fmt::format("{:04x}", (hash >> 16 ^ hash) & 0xffffU);
}

/// A row and the seals of its cells.
std::vector<std::string> sealed(std::vector<std::string> row) {
    std::string seals;
    for (std::string& cell : row) {
        for (char& c : cell)
            if (c == '\n' || c == '\r') c = ' ';
        seals += seal_of(cell);
    }
    row.push_back(seals);
    return row;
}

/// What is wrong with a line; empty where nothing is.
std::string damage(const std::vector<std::string>& cells, const std::vector<std::string>& columns) {
    const std::string& seals = cells.back();
    if (seals.size() != 4 * columns.size())
        return fmt::format("has no seals of {} cells at its end", columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k)
        if (k + 1 >= cells.size() || seal_of(cells[k]) != seals.substr(4 * k, 4))
            return fmt::format("column '{}' is not what was written{}", columns[k],
                               k + 1 < cells.size() ? ": '" + cells[k] + "'" : "");
    if (cells.size() != columns.size() + 1)
        return fmt::format("has {} cells in place of {}", cells.size(), columns.size() + 1);
    return {};
}

}  // namespace

bool StudyTable::unfinished(const std::filesystem::path& folder, std::string_view name) {
    std::error_code error;
    return std::filesystem::exists(folder / fmt::format("{}.part.csv", name), error);
}

StudyTable::StudyTable(const RunFolder& folder, std::string name, std::vector<std::string> columns)
    : folder_(folder),
      name_(std::move(name)),
      columns_(std::move(columns)) {
    std::ifstream in(part(), std::ios::binary);
    std::streamoff whole = 0;
    std::string line;
    for (int number = 1; std::getline(in, line) && !in.eof();
         ++number) {  // the last: without an end
        const bool torn = line.empty() || line.find('\0') != std::string::npos;
        if (torn && in.peek() == std::ifstream::traits_type::eof()) break;  // the power failed
        read(line, number);
        whole = in.tellg();
    }
    if (in.bad()) refuse(0, "cannot be read to its end");
    in.close();
    if (whole == 0) {
        folder_.write(name_ + ".part.csv", csv_line(header()));
        return;
    }
    separate_file(part());
    std::error_code error;
    std::filesystem::resize_file(part(), static_cast<std::uintmax_t>(whole), error);
    if (error)
        throw OutputError(fmt::format("cannot write '{}': {}", part().string(), error.message()));
}

StudyTable::Row StudyTable::header() const {
    Row all = columns_;
    all.push_back(check_column);
    return all;
}

void StudyTable::read(const std::string& line, int number) {
    Row row = csv_cells(line);
    if (number == 1) {
        const Row expected = header();
        if (row == expected) return;
        const auto at = static_cast<std::size_t>(
            std::mismatch(row.begin(), row.end(), expected.begin(), expected.end()).first -
            row.begin());
        refuse(1, fmt::format("has other columns ('{}' in place of '{}')",
                              at < row.size() ? row[at] : "nothing",
                              at < expected.size() ? expected[at] : "nothing"));
    }
    if (const auto wrong = damage(row, columns_); !wrong.empty()) refuse(number, wrong);
    row.pop_back();
    if (!rows_.emplace(row.front(), row).second)
        refuse(number, fmt::format("holds '{}' a second time", row.front()));
}

/// The file stays as it is. `line`: 0 for all of it.
void StudyTable::refuse(int line, const std::string& why) const {
    throw InputError(fmt::format("out: '{}'{}: {}; choose another --out, or --force to begin anew",
                                 part().string(),
                                 line > 0 ? fmt::format(" line {}", line) : std::string{}, why));
}

/// One write of the whole line: a kill leaves it there or not, the power failing may tear it.
void StudyTable::append(const Row& row) {
    const std::string line = csv_line(sealed(row));
    const int file = open(part().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    const off_t end = file >= 0 ? lseek(file, 0, SEEK_END) : 0;
    const bool written =
        file >= 0 && write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size()) &&
        fsync(file) == 0;
    // The next row would be glued to half a one.
    const bool taken_back = written || file < 0 || ftruncate(file, end) == 0;
    if (file >= 0) close(file);
    if (!written || !taken_back)
        throw OutputError(fmt::format("cannot write '{}' (disk full?)", part().string()));
    rows_[row.front()] = row;
}

bool StudyTable::run(const std::vector<StudyTask>& tasks, int threads,
                     const std::function<void(std::size_t known)>& on_row) {
    std::vector<const StudyTask*> open_tasks;
    for (const StudyTask& task : tasks)
        if (!rows_.contains(task.name)) open_tasks.push_back(&task);

    std::mutex mutex;
    std::condition_variable news;
    std::atomic<std::size_t> next{0};
    std::size_t working = static_cast<std::size_t>(std::max(1, threads));
    std::exception_ptr error;
    const auto work = [&] {
        set_threads(1);  // of loops within this thread
        bool interrupted = false;
        while (!interrupted && InterruptWatch::received() == 0) {
            const std::size_t k = next++;
            if (k >= open_tasks.size()) break;
            try {
                const auto cells = open_tasks[k]->compute();
                const std::lock_guard lock(mutex);
                interrupted = !cells || error;
                if (interrupted) continue;
                Row row{open_tasks[k]->name};
                row.insert(row.end(), cells->begin(), cells->end());
                append(row);
            } catch (const Interrupted&) {
                interrupted = true;
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!error) error = std::current_exception();
                interrupted = true;
            }
            news.notify_one();
        }
        const std::lock_guard lock(mutex);
        --working;
        news.notify_one();
    };
    std::vector<std::thread> workers;
    for (std::size_t n = working; workers.size() < n;) try {
            workers.emplace_back(work);
        } catch (const std::system_error& refusal) {  // fewer do it as well
            const std::lock_guard lock(mutex);
            working -= n - workers.size();
            if (workers.empty())
                throw InputError(
                    fmt::format("jobs: no thread can be started ({}); raise the limits "
                                "on processes and memory (ulimit -u, -v)",
                                refusal.code().message()));
            break;
        }
    {
        std::unique_lock lock(mutex);
        while (working > 0) {
            news.wait_for(lock, std::chrono::milliseconds(200));
            if (error) continue;
            try {
                on_row(rows_.size());
            } catch (...) {  // threads must have ended before it goes on
                error = std::current_exception();
            }
        }
    }
    for (std::thread& worker : workers) worker.join();
    if (error) std::rethrow_exception(error);

    const auto all = rows(tasks);
    if (all.size() < tasks.size()) return false;
    std::string text = csv_line(columns_);
    for (const Row& row : all) text += csv_line(row);
    folder_.write(name_ + ".csv", text);
    std::error_code ignored;
    std::filesystem::remove(part(), ignored);
    return true;
}

namespace {

std::size_t place_of(const std::vector<std::string>& columns, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
}

}  // namespace

const std::string& cell_of(const StudyTable::Row& row, const std::vector<std::string>& columns,
                           std::string_view name) {
    return row.at(place_of(columns, name));
}

double number_in_cell(const StudyTable::Row& row, std::size_t column) {
    const std::string& cell = row.at(column);
    if (cell.empty()) return std::nan("");
    double value = 0.0;  // infinite, or none, where a run was stopped
    const char* const last = cell.data() + cell.size();
    const auto [end, error] = std::from_chars(cell.data(), last, value);
    if (error != std::errc{} || end != last)
        throw InputError(fmt::format("out: row '{}': '{}' is no number; begin anew with --force",
                                     row.front(), one_line(cell)));
    return value;
}

double number_of(const StudyTable::Row& row, const std::vector<std::string>& columns,
                 std::string_view name) {
    return number_in_cell(row, place_of(columns, name));
}

std::vector<StudyTable::Row> StudyTable::rows(const std::vector<StudyTask>& tasks) const {
    std::vector<Row> known;
    for (const StudyTask& task : tasks)
        if (const auto row = rows_.find(task.name); row != rows_.end())
            known.push_back(row->second);
    return known;
}

}  // namespace spam

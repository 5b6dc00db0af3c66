// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parallel.hpp>
#include <spam/io/study_table.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <fstream>
#include <mutex>
#include <thread>

namespace spam {

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

bool StudyTable::unfinished(const std::filesystem::path& folder, std::string_view name) {
    std::error_code error;
    return std::filesystem::exists(folder / fmt::format("{}.part.csv", name), error);
}

StudyTable::StudyTable(const RunFolder& folder, std::string name, std::vector<std::string> columns)
    : folder_(folder),
      name_(std::move(name)),
      columns_(std::move(columns)) {
    std::ifstream in(part(), std::ios::binary);
    if (!in) {
        folder_.write(name_ + ".part.csv", csv_line(columns_));
        return;
    }
    std::string line;
    std::streamoff whole = 0;
    bool first = true;
    while (std::getline(in, line) && !in.eof()) {  // at the end of the file the line has no end
        Row row = csv_cells(line);
        if (first && row != columns_)
            throw InputError(fmt::format(
                "out: '{}' has other columns; choose another --out, or --force to begin anew",
                part().string()));
        if (row.size() != columns_.size()) break;
        if (!first) rows_[row.front()] = row;
        first = false;
        whole = in.tellg();
    }
    in.close();
    std::error_code error;
    std::filesystem::resize_file(part(), static_cast<std::uintmax_t>(whole), error);
    if (error || first) folder_.write(name_ + ".part.csv", csv_line(columns_));
}

/// One write of the whole line: a kill leaves it there or not, the power failing may tear it.
void StudyTable::append(const Row& row) {
    const std::string line = csv_line(row);
    const int file = open(part().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    const bool written =
        file >= 0 && write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size()) &&
        fsync(file) == 0;
    if (file >= 0) close(file);
    if (!written) throw OutputError(fmt::format("cannot write '{}' (disk full?)", part().string()));
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
        set_threads(1);  // of OpenMP, within this thread
        bool interrupted = false;
        while (!interrupted) {
            const std::size_t k = next++;
            if (k >= open_tasks.size()) break;
            try {
                const auto cells = open_tasks[k]->compute();
                const std::lock_guard lock(mutex);
                interrupted = !cells || error;
                if (!cells) continue;
                Row row{open_tasks[k]->name};
                row.insert(row.end(), cells->begin(), cells->end());
                append(row);
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
    for (std::size_t k = 0, n = working; k < n; ++k) workers.emplace_back(work);
    {
        std::unique_lock lock(mutex);
        while (working > 0) {
            news.wait_for(lock, std::chrono::milliseconds(200));
            on_row(rows_.size());
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

std::vector<StudyTable::Row> StudyTable::rows(const std::vector<StudyTask>& tasks) const {
    std::vector<Row> known;
    for (const StudyTask& task : tasks)
        if (const auto row = rows_.find(task.name); row != rows_.end())
            known.push_back(row->second);
    return known;
}

}  // namespace spam

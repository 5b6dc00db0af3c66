// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_descriptor.hpp"
#include <spam/core/error.hpp>
#include <spam/io/terminal.hpp>
#include <spam/processes/processes.hpp>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace spam {

namespace {

/// Prints and forgets: a reader that has left or a full disk behind it must not end a run.
void print(std::FILE* stream, std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stream);
    std::fflush(stream);
}

/// Where lines after the first begin: under the second column of "key      text", else at 4.
std::size_t hanging_indent(std::string_view text) {
    const std::size_t gap = text.find("  ");
    const std::size_t word = gap == 0 ? std::string_view::npos : text.find_first_not_of(' ', gap);
    return gap != std::string_view::npos && word != std::string_view::npos && word <= 16 ? word : 4;
}

/// As many of the fields of `text`, separated by two spaces, as fit into `width` columns.
std::string_view whole_fields(std::string_view text, std::size_t width) {
    if (text.size() <= width) return text;
    const std::size_t gap = text.rfind("  ", width);
    return text.substr(0, gap == std::string_view::npos || gap == 0 ? width : gap);
}

}  // namespace

std::string wrap(std::string_view text, std::size_t width) {
    const std::size_t indent = std::min(hanging_indent(text), width / 4);
    std::string out;
    std::size_t column = 0;
    std::size_t pos = 0;
    while (pos < text.size()) {
        const std::size_t word = std::min(text.find_first_not_of(' ', pos), text.size());
        const std::size_t end = std::min(text.find(' ', word), text.size());
        std::string_view piece = text.substr(pos, end - pos);  // a word and the spaces before it
        if (column > indent && column + piece.size() > width) {
            piece = text.substr(word, end - word);
            out += '\n' + std::string(indent, ' ');
            column = indent;
        }
        while (column + piece.size() > width) {  // a word longer than a line
            std::size_t room = width > column ? width - column : 0;
            while (room > 0 && (static_cast<unsigned char>(piece[room]) & 0xc0) == 0x80) --room;
            if (room == 0 && column <= indent)  // no letter begins in it
                room = std::min(piece.size(), width - indent);
            out += piece.substr(0, room);
            out += '\n' + std::string(indent, ' ');
            piece.remove_prefix(room);
            column = indent;
        }
        out += piece;
        column += piece.size();
        pos = end;
    }
    return out;
}

Terminal::Terminal(bool quiet)
    : quiet_(quiet),
      is_terminal_(isatty(STDOUT_FILENO) == 1 && !started_with_others()) {}

std::size_t Terminal::width() const {
    winsize size{};
    if (!is_terminal_ || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20)
        return 100;
    return size.ws_col;
}

void Terminal::log_to(const std::filesystem::path& path) {
    log_path_ = path;
    separate_file(path);
    log_.open(path, std::ios::app);  // a study that goes on has begun its log before
    log("");
}

void Terminal::log(std::string_view text) {
    if (log_path_.empty()) return;
    if (!text.empty()) log_ << text << '\n';
    log_.flush();
    if (!log_) throw OutputError(fmt::format("cannot write '{}' (disk full?)", log_path_.string()));
}

void Terminal::say(std::string_view text) {
    end_progress();
    log(text);
    if (quiet_) return;
    std::size_t pos = 0;
    while (pos <= text.size()) {
        const std::size_t end = std::min(text.find('\n', pos), text.size());
        print(stdout, wrap(text.substr(pos, end - pos), width()) + '\n');
        pos = end + 1;
    }
}

void Terminal::warn(std::string_view text) {
    end_progress();
    const bool on_terminal = is_terminal_ && isatty(STDERR_FILENO) == 1;
    print(stderr, (on_terminal ? wrap(text, width()) : std::string(text)) + '\n');
    log(text);
}

/// Of a short run few tenths: lines are read no faster than they come.
bool Terminal::line_due(double fraction) const {
    if (fraction < 0.1 * next_tenth_) return false;
    return fraction >= 1.0 ||
           std::chrono::steady_clock::now() - written_ >= std::chrono::milliseconds(400);
}

bool Terminal::progress_due(double fraction) {
    if (!is_terminal_ || quiet_) return line_due(fraction);
    return std::chrono::steady_clock::now() - drawn_ >= std::chrono::milliseconds(100);
}

void Terminal::progress(double fraction, std::string_view text) {
    if (line_due(fraction)) {
        while (fraction >= 0.1 * next_tenth_) ++next_tenth_;
        written_ = std::chrono::steady_clock::now();
        log(text);
        if (!is_terminal_ && !quiet_) {
            print(stdout, std::string(text) + '\n');
        }
    }
    if (!is_terminal_ || quiet_) return;
    drawn_ = std::chrono::steady_clock::now();
    print(stdout, fmt::format("\r\x1b[K{}", whole_fields(text, width() - 1)));
    line_open_ = true;
}

void Terminal::begin_progress() {
    next_tenth_ = 1;
    written_ = std::chrono::steady_clock::now();
}

void Terminal::end_progress() {
    if (!line_open_) return;
    print(stdout, "\r\x1b[K");
    line_open_ = false;
}

}  // namespace spam

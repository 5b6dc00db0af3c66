// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace spam::test {

/// A terminal without a right edge: what was written where, so that a test can tell how wide lines
/// became at any moment and what is left at the end. Knows carriage return, line feed, and ESC [ K;
/// throws for any other control character.
class Screen {
  public:
    explicit Screen(std::string_view written) : lines_(1) {
        for (std::size_t k = 0; k < written.size(); ++k) {
            const char c = written[k];
            if (c == '\r') {
                column_ = 0;
            } else if (c == '\n') {
                lines_.emplace_back();
                column_ = 0;
            } else if (written.substr(k, 3) == "\x1b[K") {
                lines_.back().resize(std::min(column_, lines_.back().size()));
                k += 2;
            } else if (static_cast<unsigned char>(c) < 0x20) {
                throw std::runtime_error("control character " + std::to_string(c));
            } else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) {  // one per code point
                put(c);
            }
        }
    }
    /// The largest number of columns any line ever took.
    std::size_t widest() const { return widest_; }
    /// What a user sees at the end.
    const std::vector<std::string>& lines() const { return lines_; }
    bool shows(std::string_view text) const {
        return std::any_of(lines_.begin(), lines_.end(),
                           [&](const auto& line) { return line.find(text) != line.npos; });
    }

  private:
    void put(char c) {
        std::string& line = lines_.back();
        if (line.size() <= column_) line.resize(column_ + 1, ' ');
        line[column_++] = c;
        widest_ = std::max(widest_, column_);
    }
    std::vector<std::string> lines_;
    std::size_t column_ = 0, widest_ = 0;
};

}  // namespace spam::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace spam {

/// Breaks `text` into lines of at most `width` characters at spaces. Lines after the first are
/// indented: below the text of "key      text", otherwise by 4. A word longer than a line stays
/// whole.
std::string wrap(std::string_view text, std::size_t width);

/// What a run tells its user: lines on the terminal, wrapped to its width, and the same lines whole
/// in run.log. On a terminal the progress line is drawn in place; elsewhere a plain line is printed
/// at tenths of the run and at its end, but no sooner than 0.4 seconds after the last. Quiet: nothing on the
/// terminal, everything in the log.
class Terminal {
  public:
    explicit Terminal(bool quiet);
    ~Terminal() { end_progress(); }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    /// Starts a log file; throws OutputError when it cannot be written.
    void log_to(const std::filesystem::path& path);

    /// One line (or several, separated by '\n').
    void say(std::string_view text);
    /// To the log only.
    void log(std::string_view text);
    /// To standard error, also when quiet, and to the log.
    void warn(std::string_view text);

    /// A new run starts at 0 %.
    void begin_progress();
    /// Progress: `fraction` in [0, 1], `text` the whole line, most important first; cut to the
    /// width.
    void progress(double fraction, std::string_view text);
    /// Whether a progress line is due, so that its text need not be composed for nothing.
    bool progress_due(double fraction);
    /// Removes the progress line, before other output.
    void end_progress();

  private:
    std::size_t width() const;
    bool line_due(double fraction) const;

    bool quiet_;
    bool is_terminal_;
    bool line_open_ = false;
    int next_tenth_ = 1;
    std::chrono::steady_clock::time_point drawn_{};    ///< in place
    std::chrono::steady_clock::time_point written_{};  ///< as a line
    std::filesystem::path log_path_;
    std::ofstream log_;
};

}  // namespace spam

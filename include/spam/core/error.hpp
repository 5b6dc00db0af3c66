// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace spam {

/// Something the user asked for cannot be done: one line that names what, where, the allowed values
/// and the fix. A problem ends with exit status 2, before anything is computed or written.
class InputError : public std::runtime_error {
  public:
    explicit InputError(std::string message) : std::runtime_error(visible(std::move(message))) {}

  private:
    /// what() would end at a NUL that came with the input.
    static std::string visible(std::string text) {
        for (std::size_t at; (at = text.find('\0')) != std::string::npos;)
            text.replace(at, 1, "\\x00");
        return text;
    }
};

/// Results could not be written during a run (disk full, folder removed): exit status 4.
class OutputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A numerical guard stopped the run: exit status 3. The message carries the reason and the time.
class GuardStop : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace spam

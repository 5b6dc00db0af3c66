// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace spam {

/// Something the user asked for cannot be done: one line that names what, where, the allowed values
/// and the fix. A problem ends with exit status 2, before anything is computed or written.
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
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

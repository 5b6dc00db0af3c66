// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/parts.hpp>

#include <pybind11/pybind11.h>

#include <chrono>
#include <cstddef>

/// What a module shares with the process that has loaded it: threads, signals, other processes.
namespace spam::python {

/// A number of threads that is asked for: 0 to 4096. Throws InputError.
int checked_threads(int threads);

/// The processes that share every run of this script where mpirun has started it several times: joined at the first
/// call, left when the interpreter ends. Otherwise one that is alone.
Parts& processes();

/// Ends a long computation soon after Ctrl-C. Call where the interpreter is not held; looks for signals by the
/// clock, every 50 ms, and throws py::error_already_set (KeyboardInterrupt, or what a handler raised).
class Signals {
  public:
    void look() {
        const auto now = std::chrono::steady_clock::now();
        if (now - latest_ < std::chrono::milliseconds(50)) return;
        latest_ = now;
        ask();
    }

  private:
    static void ask();
    std::chrono::steady_clock::time_point latest_ = std::chrono::steady_clock::now();
};

}  // namespace spam::python

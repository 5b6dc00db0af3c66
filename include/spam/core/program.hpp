// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spam {

/// Full name of a program on PATH; empty where there is none.
std::filesystem::path find_program(const std::string& name);

/// Makes a folder for what is not kept, of a new name that begins so, where the system has room for such (TMPDIR, else
/// /tmp). Throws OutputError.
std::filesystem::path make_temporary_folder(const std::string& name);

/// Starts a program and waits for its end. It reads nothing and what it prints is dropped.
struct Command {
    std::vector<std::string> words;      ///< the program (looked for on PATH), then its arguments
    std::filesystem::path folder{};      ///< where it works; empty: here
    std::filesystem::path error_file{};  ///< what it says of errors; empty: dropped

    /// Its exit status; nothing where it could not be started or was ended by a signal.
    std::optional<int> run() const;
};

}  // namespace spam

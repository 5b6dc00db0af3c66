// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace spam::view {

/// The whole of a file. Throws InputError where it is no file that can be read to its end.
std::string contents(const std::filesystem::path& path);

/// Whether a file may be made or replaced there, tried without touching what is there. Throws InputError
/// where not: a read-only folder, a folder of that name, a file that is no page of ours.
void check_writable(const std::filesystem::path& path);

/// Writes a whole file: to a name beside it, then renamed. Throws OutputError.
void write_file(const std::filesystem::path& path, std::string_view text);

/// How a page of ours begins.
inline constexpr std::string_view page_mark = "<!DOCTYPE html>\n<!-- A page of spam view -->\n";

}  // namespace spam::view

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace spam {

/// The whole of a file that a user names with --`option`: `expected` says of what kind ("a TOML file of
/// options"). Throws InputError where it cannot be read to its end, or is longer than 16 MiB.
std::string text_file(const std::string& path, const std::string& option,
                      const std::string& expected);

}  // namespace spam

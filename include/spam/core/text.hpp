// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace spam {

/// The candidate nearest to `word` by edit distance, for 'did you mean'; empty without candidates.
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// `text` as one line: control characters as \n, \t, \x1b, so that a message stays a message.
std::string one_line(std::string_view text);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace spam {

/// The candidate that contains `word`, or is nearest to it by edit distance; empty when none is
/// near (two changes, or a third of the letters of long words).
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// How a sentence about an unknown word ends: "; did you mean <prefix><nearest>?", or ".".
std::string suggestion(std::string_view word, std::span<const std::string> candidates,
                       std::string_view prefix = "");

/// A word that is a finite number, or a whole one that fits, from its first letter to its last; one sign
/// may come first, + or -.
std::optional<double> number_in(std::string_view word);
std::optional<int> whole_number_in(std::string_view word);

/// `text` as one line: control characters as `\n`, `\t`, `\x1b`, so that a message stays a message.
std::string one_line(std::string_view text);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// What every kind of picture needs of gnuplot.
#pragma once

#include <spam/io/run_folder.hpp>

#include <string>
#include <string_view>

namespace spam::gnuplot {

/// Text inside double quotes of an enhanced-mode gnuplot string.
std::string escaped(std::string_view text);

/// How a script begins: where it draws to, and how large (pixels).
std::string preamble(std::string_view name, double width, double height);

/// Dark to light, also for readers without colour vision.
extern const std::string_view palette;
/// Line styles 1 to 6, distinct without colour vision.
extern const std::string_view line_styles;
inline constexpr int styles = 6;

/// Writes <name>.dat and <name>.gp and draws <name>.png; false when gnuplot is missing or fails.
/// Throws OutputError when script or data cannot be written.
bool draw(const RunFolder& folder, std::string_view name, const std::string& script,
          const std::string& data);

}  // namespace spam::gnuplot

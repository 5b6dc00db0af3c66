// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnuplot_script.hpp"

#include "../io/file_descriptor.hpp"
#include <spam/core/error.hpp>
#include <spam/core/program.hpp>

#include <fmt/format.h>

namespace spam::gnuplot {
namespace {

/// Runs gnuplot on <name>.gp inside the folder; false when it is missing or fails. What it said of a failure stays
/// beside the script.
bool run(const RunFolder& folder, const std::string& script) {
    const std::filesystem::path said = folder / (script + ".err");
    begin_file(said);
    const auto status = Command{{"gnuplot", script}, folder.path(), said}.run();
    std::error_code ignored;
    if (status == 0 || !status) std::filesystem::remove(said, ignored);
    return status == 0;
}

/// Whether a picture has its last piece: gnuplot does not look at what becomes of its output.
bool is_whole(const std::filesystem::path& picture) {
    static constexpr std::string_view end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
    return contents_of_file(picture).ends_with(end);
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '\n') {
            out += "\\n";
            continue;
        }
        if (c == '_' || c == '^' || c == '{' || c == '}' || c == '@' || c == '&' || c == '~')
            out += "\\\\";
        if (c == '"' || c == '\\' || c == '`')
            out += '\\';  // gnuplot runs what stands in backquotes
        out += c;
    }
    return out;
}

std::string preamble(std::string_view name, double width, double height) {
    return fmt::format(
        "# Draw again with: gnuplot {0}.gp\n"
        "set terminal pngcairo size {1:.0f},{2:.0f} font 'Sans,13' background rgb 'white'\n"
        "set output '{0}.png'\n"
        "set encoding utf8\n",
        name, width, height);
}

const std::string_view palette =
    "set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 "
    "'#fde725')\n";

const std::string_view line_styles =
    "set style line 1 lw 2.5 lc rgb '#000000' pt 7 ps 0.7\n"
    "set style line 2 lw 2.5 lc rgb '#d55e00' pt 7 ps 0.7\n"
    "set style line 3 lw 2.5 lc rgb '#0072b2' pt 7 ps 0.7\n"
    "set style line 4 lw 2.5 lc rgb '#009e73' dt 2 pt 7 ps 0.7\n"
    "set style line 5 lw 2.5 lc rgb '#cc79a7' pt 7 ps 0.7\n"
    "set style line 6 lw 2.5 lc rgb '#e69f00' pt 7 ps 0.7\n";

bool draw(const RunFolder& folder, std::string_view name, const std::string& script,
          const std::string& data) {
    folder.write(fmt::format("{}.dat", name), data);
    folder.write(fmt::format("{}.gp", name), script);
    const std::filesystem::path picture = folder / fmt::format("{}.png", name);
    std::error_code ignored;
    std::filesystem::remove(picture, ignored);  // of an earlier run, or a link
    const bool drawn = run(folder, fmt::format("{}.gp", name)) && is_something(picture);
    if (drawn && is_whole(picture)) return true;
    std::filesystem::remove(picture, ignored);
    if (drawn) throw OutputError(fmt::format("cannot write '{}' (disk full?)", picture.string()));
    return false;
}

}  // namespace spam::gnuplot

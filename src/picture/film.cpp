// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/program.hpp>
#include <spam/picture/film.hpp>

namespace spam {

std::string make_film(const RunFolder& folder, std::string_view name, int frames_per_second) {
    if (find_program("ffmpeg").empty()) return "ffmpeg is not installed";
    const std::string film_name = std::string(name) + ".mp4";
    std::error_code ignored;
    std::filesystem::remove(folder / film_name, ignored);  // an older one, or a link
    const Command film{.words = {"ffmpeg", "-y", "-loglevel", "error", "-framerate",
                                 std::to_string(frames_per_second), "-pattern_type", "glob", "-i",
                                 "frame_*.png", "-pix_fmt", "yuv420p", film_name},
                       .folder = folder.path()};
    if (film.run() == 0) return "";
    std::filesystem::remove(folder / film_name, ignored);
    return "ffmpeg failed";
}

}  // namespace spam

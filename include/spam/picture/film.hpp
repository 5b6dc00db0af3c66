// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/run_folder.hpp>

#include <string>
#include <string_view>

namespace spam {

/// NAME.mp4 from the pictures frame_*.png in the folder, in the order of their names, by ffmpeg, in
/// place of an older one. Returns why there is none ("ffmpeg is not installed", "ffmpeg failed"), or nothing.
std::string make_film(const RunFolder& folder, std::string_view name, int frames_per_second);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/picture/film.hpp>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace spam {

std::string make_film(const RunFolder& folder, std::string_view name, int frames_per_second) {
    std::string command =
        "cd -- \"$1\" && command -v ffmpeg >/dev/null || exit 127\n"
        "exec ffmpeg -y -loglevel error -framerate \"$3\"  -pattern_type glob "
        "-i 'frame_*.png' -pix_fmt yuv420p \"$2\" </dev/null >/dev/null 2>&1";
    std::string shell = "sh", flag = "-c", self = "film", path = folder.path().string(),
                file = std::string(name) + ".mp4", rate = std::to_string(frames_per_second);
    char* argv[] = {shell.data(), flag.data(), command.data(), self.data(),
                    path.data(),  file.data(), rate.data(),    nullptr};
    pid_t pid = 0;
    int status = -1;
    if (posix_spawnp(&pid, "sh", nullptr, nullptr, argv, environ) != 0 ||
        waitpid(pid, &status, 0) != pid || !WIFEXITED(status))
        return "ffmpeg failed";
    if (WEXITSTATUS(status) == 127) return "ffmpeg is not installed";
    return WEXITSTATUS(status) == 0 ? "" : "ffmpeg failed";
}

}  // namespace spam

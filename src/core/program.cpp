// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/program.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

extern char** environ;

namespace spam {
namespace fs = std::filesystem;

fs::path find_program(const std::string& name) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path file = fs::path(folder) / name;
        std::error_code ignored;
        if (fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0) return file;
    }
    return {};
}

fs::path make_temporary_folder(const std::string& name) {
    std::error_code error;
    const fs::path where = fs::temp_directory_path(error);
    if (error)
        throw OutputError(fmt::format(
            "TMPDIR: there is no folder for temporary files ({}); set it to one that can be written",
            error.message()));
    std::string folder = where / (name + "-XXXXXX");
    if (mkdtemp(folder.data()) == nullptr)
        throw OutputError(
            fmt::format("cannot make a folder in {} ({})", where.string(), std::strerror(errno)));
    return folder;
}

std::optional<int> Command::run() const {
    posix_spawn_file_actions_t actions;
    if (posix_spawn_file_actions_init(&actions) != 0) return {};
    const std::string errors = error_file.empty() ? "/dev/null" : fs::absolute(error_file).string();
    bool ready = posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0) == 0;
    ready = ready && posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0) == 0;
    ready = ready && posix_spawn_file_actions_addopen(&actions, 2, errors.c_str(),
                                                      O_WRONLY | O_CREAT | O_TRUNC, 0666) == 0;
    if (!folder.empty())
        ready = ready && posix_spawn_file_actions_addchdir_np(&actions, folder.c_str()) == 0;
    std::vector<std::string> copies = words;
    std::vector<char*> arguments;
    for (std::string& word : copies) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    const bool started = ready && posix_spawnp(&child, arguments.front(), &actions, nullptr,
                                               arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    if (!started) return {};
    int status = 0;
    while (waitpid(child, &status, 0) != child)
        if (errno != EINTR) return {};
    if (!WIFEXITED(status)) return {};
    return WEXITSTATUS(status);
}

}  // namespace spam

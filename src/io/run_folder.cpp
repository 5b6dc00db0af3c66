// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/io/run_folder.hpp>

#include <fmt/format.h>

#include <fstream>

namespace spam {
namespace fs = std::filesystem;

namespace {

bool holds_current_folder(const fs::path& path) {
    std::error_code error;
    for (fs::path here = fs::current_path(error); !error; here = here.parent_path()) {
        if (fs::equivalent(here, path, error)) return true;
        if (here == here.root_path()) break;
    }
    return false;
}

void move_aside(const fs::path& path) {
    std::error_code error;
    for (int k = 1;; ++k) {
        fs::path aside = path;
        aside += fmt::format(".old-{}", k);
        if (fs::exists(fs::symlink_status(aside, error))) continue;
        fs::rename(path, aside, error);
        if (error)
            throw InputError(fmt::format("out: cannot move '{}' aside to '{}': {}", path.string(),
                                         aside.string(), error.message()));
        return;
    }
}

}  // namespace

RunFolder::RunFolder(const fs::path& path, bool force) : path_(path) {
    std::error_code error;
    while (path_.has_relative_path() && !path_.has_filename()) path_ = path_.parent_path();
    const auto status = fs::status(path_, error);
    if (fs::exists(status)) {
        const bool usable = fs::is_directory(status) && fs::is_empty(path_, error) && !error;
        if (!fs::is_directory(status))
            throw InputError(
                fmt::format("out: '{}' is not a folder; choose another --out", path_.string()));
        if (!usable && force && holds_current_folder(path_))
            throw InputError(fmt::format(
                "out: '{}' is or contains the current folder and cannot be moved aside; choose "
                "another --out",
                path_.string()));
        // --force is for results of earlier runs, not for a home or a thesis named by mistake.
        if (!usable && !fs::exists(path_ / "run.log", error))
            throw InputError(
                fmt::format("out: '{}' is not empty and holds no results of a run (no run.log), so "
                            "that even --force leaves it alone; choose another --out",
                            path_.string()));
        if (!usable && !force)
            throw InputError(fmt::format(
                "out: '{}' exists; add --force to move it aside, or choose another --out",
                path_.string()));
        if (!usable) move_aside(path_);
    }
    fs::create_directories(path_, error);
    if (error)
        throw InputError(fmt::format("out: cannot create '{}': {}; choose another --out",
                                     path_.string(), error.message()));
    const fs::path probe = path_ / ".writable";
    if (!std::ofstream(probe))
        throw InputError(
            fmt::format("out: cannot write into '{}'; choose another --out", path_.string()));
    fs::remove(probe, error);
}

RunFolder RunFolder::inside(std::string_view name) const {
    std::error_code error;
    fs::create_directories(path_ / name, error);
    if (error)
        throw OutputError(
            fmt::format("cannot create '{}': {}", (path_ / name).string(), error.message()));
    return RunFolder(path_ / name);
}

void RunFolder::write(std::string_view name, std::string_view contents) const {
    write(name, [contents](std::ostream& out) {
        out.write(contents.data(), static_cast<std::streamsize>(contents.size()));
    });
}

void RunFolder::write(std::string_view name,
                      const std::function<void(std::ostream&)>& contents) const {
    const fs::path target = path_ / name;
    fs::path temporary = target;
    temporary += ".tmp";
    std::ofstream out(temporary, std::ios::binary);
    contents(out);
    out.close();
    std::error_code error;
    if (out) fs::rename(temporary, target, error);
    if (!out || error) {
        fs::remove(temporary, error);
        throw OutputError(fmt::format("cannot write '{}' (disk full?)", target.string()));
    }
}

}  // namespace spam

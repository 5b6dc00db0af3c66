// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_descriptor.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/io/run_folder.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
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

/// Why an existing folder cannot be moved aside; empty where it can.
std::string why_not(const fs::path& path, bool force) {
    std::error_code error;
    if (force && holds_current_folder(path))
        return fmt::format(
            "out: '{}' is or contains the current folder and cannot be moved aside; choose another "
            "--out",
            path.string());
    // --force is for results of earlier runs, not for a home or a thesis named by mistake.
    if (!fs::exists(path / "run.log", error))
        return fmt::format(
            "out: '{}' is not empty and holds no results of a run (no run.log), so that even "
            "--force leaves it alone; choose another --out",
            path.string());
    if (!force)
        return fmt::format(
            "out: '{}' exists; add --force to move it aside, or choose another --out",
            path.string());
    return {};
}

void create(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (error)
        throw InputError(fmt::format("out: cannot create '{}': {}; choose another --out",
                                     path.string(), error.message()));
}

/// The folder, empty and locked; what it held is moved aside. Between any two lines another process may
/// take, move or remove a folder of that name: what has been found counts only once the lock is held
/// and is still that of the name.
FolderLock take(const fs::path& path, bool force) {
    constexpr int attempts = 1000;
    std::error_code error;
    for (int k = 0; k < attempts; ++k) {
        if (fs::exists(path, error) && !fs::is_directory(path, error))
            throw InputError(
                fmt::format("out: '{}' is not a folder; choose another --out", path.string()));
        create(path);
        FolderLock lock(path);
        if (!lock.is_of(path)) {
            if (::access(path.c_str(), R_OK) != 0 && errno == EACCES) break;
            continue;
        }
        if (fs::is_empty(path, error) && !error) return lock;
        if (const std::string reason = why_not(path, force); !reason.empty())
            throw InputError(reason);
        move_aside(path);
    }
    throw InputError(fmt::format("out: cannot read '{}'; choose another --out", path.string()));
}

}  // namespace

RunFolder::RunFolder(const fs::path& path, bool force) : path_(path) {
    while (path_.has_relative_path() && !path_.has_filename()) path_ = path_.parent_path();
    lock_ = take(path_, force);
    const fs::path probe = path_ / ".writable";
    if (!std::ofstream(probe))
        throw InputError(
            fmt::format("out: cannot write into '{}'; choose another --out", path_.string()));
    std::error_code error;
    fs::remove(probe, error);
}

RunFolder RunFolder::reopen(const fs::path& path, std::chrono::milliseconds patience) {
    RunFolder folder(path);
    folder.lock_.emplace(path, patience);
    if (!folder.is_there())
        throw InputError(
            fmt::format("out: '{}' cannot be read, or another run has just moved it aside; look at "
                        "what is there now and start again",
                        path.string()));
    return folder;
}

void RunFolder::check_own() const {
    std::error_code error;
    const auto options = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator it(path_, options, error), end; !error && it != end;
         it.increment(error)) {
        const fs::file_status status = it->symlink_status(error);
        if (error || fs::is_directory(status) || fs::is_regular_file(status)) continue;
        throw InputError(fmt::format(
            "out: '{}' is {}, and a run that goes on writes into files and folders of its own only; "
            "remove it, or go on in another --out",
            one_line(it->path().string()),
            fs::is_symlink(status) ? "a link" : "neither a file nor a folder"));
    }
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
    begin_file(temporary);
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

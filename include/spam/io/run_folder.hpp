// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/folder_lock.hpp>

#include <chrono>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace spam {

/// Where a run leaves its results. Never overwrites: an existing folder with contents is refused,
/// or with `force` moved aside to PATH.old-1, -2, ... first. Held (FolderLock) as long as this or a
/// copy lives: a folder where another run is at work is refused in every case.
class RunFolder {
  public:
    /// Creates the folder. Throws InputError when it exists and is not empty (without force) or
    /// cannot be created or written.
    RunFolder(const std::filesystem::path& path, bool force);

    /// One that a run has left, to go on in; what it holds is to be read after this. Throws InputError where
    /// a run is at work in it and does not end within `patience`, and where the folder that is held is no
    /// longer that of the name, because another run has moved it aside.
    static RunFolder reopen(const std::filesystem::path& path,
                            std::chrono::milliseconds patience = {});

    /// Throws InputError where it holds, at any depth, anything but files and folders: what is written through a
    /// link lands elsewhere, and a pipe keeps its writer waiting. To be asked before going on in a folder that
    /// may have come from elsewhere.
    void check_own() const;

    /// Lets other runs have it; is_there() goes on to tell.
    void release() const {
        if (lock_) lock_->release();
    }
    /// Whether its path still names the folder that was opened.
    bool is_there() const { return !lock_ || lock_->is_of(path_); }

    /// A folder inside, created.
    RunFolder inside(std::string_view name) const;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

    /// Writes a whole file: to a temporary name, then renamed, so that a reader never sees half of
    /// it. Throws OutputError.
    void write(std::string_view name, std::string_view contents) const;
    /// Likewise, what `contents` puts into the stream, piece by piece.
    void write(std::string_view name, const std::function<void(std::ostream&)>& contents) const;

  private:
    explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}
    std::filesystem::path path_;
    std::optional<FolderLock> lock_{};
};

}  // namespace spam

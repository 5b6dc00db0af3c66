// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_descriptor.hpp"
#include <spam/core/error.hpp>
#include <spam/io/folder_lock.hpp>

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <thread>

namespace spam {

struct FolderLock::Held {
    FileDescriptor folder;
};

FolderLock::FolderLock(const std::filesystem::path& folder, std::chrono::milliseconds patience)
    : held_(std::make_shared<Held>(Held{FileDescriptor::open_to_read(folder)})) {
    if (!held_->folder.is_open()) return;  // gone or not to be read: is_of() is false
    const auto end = std::chrono::steady_clock::now() + patience;
    while (::flock(held_->folder.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        if (std::chrono::steady_clock::now() >= end)
            throw InputError(
                fmt::format("out: a run is still at work in '{}'; wait until it has ended, or "
                            "choose another --out",
                            folder.string()));
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

void FolderLock::release() const {
    if (held_->folder.is_open()) ::flock(held_->folder.get(), LOCK_UN);
}

bool FolderLock::is_of(const std::filesystem::path& folder) const {
    struct stat named, locked;
    return held_->folder.is_open() && ::stat(folder.c_str(), &named) == 0 &&
           ::fstat(held_->folder.get(), &locked) == 0 && named.st_dev == locked.st_dev &&
           named.st_ino == locked.st_ino;
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_descriptor.hpp"

#include <spam/core/error.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

namespace spam {
namespace {

template <class Call>
auto again_if_interrupted(const Call& call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

}  // namespace

FileDescriptor FileDescriptor::open_to_read(const std::filesystem::path& path) {
    return FileDescriptor(again_if_interrupted(
        [&] { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); }));
}

FileDescriptor FileDescriptor::open_regular(const std::filesystem::path& path) {
    struct stat status;
    if (::stat(path.c_str(), &status) != 0) return FileDescriptor(-1);
    if (S_ISREG(status.st_mode)) return open_to_read(path);
    errno = S_ISDIR(status.st_mode) ? EISDIR : ESPIPE;
    return FileDescriptor(-1);
}

FileDescriptor FileDescriptor::create(const std::filesystem::path& path) {
    return FileDescriptor(again_if_interrupted(
        [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); }));
}

std::size_t FileDescriptor::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t n = again_if_interrupted([&] {
            return ::pread(fd_, &bytes[done], bytes.size() - done,
                           static_cast<off_t>(offset + done));
        });
        if (n == 0) errno = 0;
        if (n <= 0) break;
        done += static_cast<std::size_t>(n);
    }
    return done;
}

bool FileDescriptor::write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t n =
            again_if_interrupted([&] { return ::write(fd_, bytes.data(), bytes.size()); });
        if (n == 0) errno = EIO;  // never for a file; must not become an endless loop
        if (n <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

bool FileDescriptor::sync() const {
    return again_if_interrupted([&] { return ::fsync(fd_); }) == 0;
}

bool FileDescriptor::close() {
    if (!is_open()) return true;
    const int fd = fd_;
    fd_ = -1;
    // Linux has closed it even when interrupted: a second call could close another thread's file.
    return ::close(fd) == 0 || errno == EINTR;
}

std::string contents_of_file(const std::filesystem::path& path) {
    const FileDescriptor file = FileDescriptor::open_regular(path);
    struct stat status;
    if (!file.is_open() || ::fstat(file.get(), &status) != 0)
        throw InputError(errno == EISDIR   ? "it is a folder"
                         : errno == ESPIPE ? "it is no regular file"
                                           : system_reason());
    std::string text(static_cast<std::size_t>(status.st_size), '\0');
    const std::size_t got = file.read_at(0, std::as_writable_bytes(std::span(text)));
    if (got < text.size() && errno != 0) throw InputError(system_reason());
    text.resize(got);
    return text;
}

bool is_something(const std::filesystem::path& path) {
    struct stat status;
    return ::lstat(path.c_str(), &status) == 0;
}

void begin_file(const std::filesystem::path& path) {
    ::unlink(path.c_str());
    FileDescriptor::create(path);
}

void separate_file(const std::filesystem::path& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        throw OutputError(fmt::format("cannot write '{}': it is a folder", path.string()));
    if (std::filesystem::hard_link_count(path, error) < 2 || error) return;
    const std::string text = contents_of_file(path);
    replace_file(path, {std::as_bytes(std::span(text))});
}

void replace_file(const std::filesystem::path& target,
                  std::initializer_list<std::span<const std::byte>> contents) {
    std::filesystem::path temporary = target;
    temporary += ".tmp";
    const auto fail = [&](const char* what) {
        const std::string reason = system_reason();
        throw OutputError(fmt::format("cannot {} '{}': {}", what, target.string(), reason));
    };
    const auto give_up = [&] {
        const int reason = errno;
        ::unlink(temporary.c_str());
        errno = reason;
        fail("write");
    };
    // Opened first: what the disk is asked to remember in the end is a name in this folder.
    const auto parent = target.has_parent_path() ? target.parent_path() : ".";
    const FileDescriptor folder = FileDescriptor::open_to_read(parent);
    if (!folder.is_open()) fail("write");
    ::unlink(temporary.c_str());  // of a run that was killed
    FileDescriptor file = FileDescriptor::create(temporary);
    if (!file.is_open()) fail("write");
    for (const auto piece : contents)
        if (!file.write(piece)) give_up();
    if (!file.sync() || !file.close()) give_up();
    if (std::rename(temporary.c_str(), target.c_str()) != 0) give_up();
    // EINVAL: a file system without such a thing for folders.
    if (!folder.sync() && errno != EINVAL) fail("be sure to keep");
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <system_error>

namespace spam {

/// What the system says about the last call that failed.
inline std::string system_reason() { return std::generic_category().message(errno); }

/// A file of POSIX that closes itself. What fails leaves its reason in errno. Calls that a signal
/// interrupts are made again.
class FileDescriptor {
  public:
    /// Does not wait for the other end of a pipe.
    static FileDescriptor open_to_read(const std::filesystem::path& path);
    /// Regular files alone, and links to them. Looked at before it is opened: a pipe would wait, a device may do
    /// something. errno is EISDIR for a folder and ESPIPE for what is neither.
    static FileDescriptor open_regular(const std::filesystem::path& path);
    /// A new file: fails where there is anything of that name, a dangling link included.
    static FileDescriptor create(const std::filesystem::path& path);

    ~FileDescriptor() { close(); }
    FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;

    bool is_open() const { return fd_ >= 0; }
    int get() const { return fd_; }

    /// Fills `bytes` from `offset` on; returns how many there were. When fewer, errno tells: 0 at
    /// the end of the file.
    std::size_t read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
    bool write(std::span<const std::byte> bytes) const;
    /// Waits until all is on the disk.
    bool sync() const;
    /// Some file systems report only here that there was no room.
    bool close();

  private:
    explicit FileDescriptor(int fd) : fd_(fd) {}
    int fd_;
};

/// All that a regular file holds. Throws InputError with the reason alone: "it is a folder".
std::string contents_of_file(const std::filesystem::path& path);

/// Whether there is anything of that name: a link that leads nowhere, or to itself, is something.
bool is_something(const std::filesystem::path& path);

/// An empty file of that name, and no longer what had it before: what a link of that name leads to, or a second
/// name of it, keeps its contents. Where that is impossible it does nothing: opening the file then fails as well.
void begin_file(const std::filesystem::path& path);

/// Where a file has other names (hard links), a copy takes the place of this one: what is appended then leaves
/// the others alone.
void separate_file(const std::filesystem::path& path);

/// Puts `contents`, one after the other, in place of `target`: at once or not at all, and on the disk when this
/// returns. Uses a temporary <target>.tmp. Throws OutputError (file and the system's reason); the earlier file is
/// then as it was, unless it was only the folder that could not be brought to the disk.
void replace_file(const std::filesystem::path& target,
                  std::initializer_list<std::span<const std::byte>> contents);

}  // namespace spam

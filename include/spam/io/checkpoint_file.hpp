// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// Named texts, arrays and bytes for one checkpoint, built in memory as an HDF5 file. HDF5 never
/// touches the disk: it takes damage for contents and crashes at exit after a full disk.
///
/// Paths are absolute ("/state/position"), their groups made as needed; each is given once, else
/// std::logic_error. Equal contents in equal order make equal bytes. Any number of writers and
/// readers may be used at a time, by any threads; one of them by one thread at a time.
class CheckpointWriter {
  public:
    /// `expected`: bytes it will hold, roughly; where it is right, nothing is copied as the file grows.
    explicit CheckpointWriter(std::size_t expected = 0);
    ~CheckpointWriter();
    CheckpointWriter(CheckpointWriter&&) noexcept;

    /// A scalar string, UTF-8; may be empty.
    void text(std::string_view path, std::string_view value);
    /// A table of rows x columns, row after row (a Dim x n column-major block has columns = Dim);
    /// every bit is kept, those of a NaN too. Throws std::logic_error when rows are not whole.
    void numbers(std::string_view path, std::span<const double> values, std::size_t columns);
    void integers(std::string_view path, std::span<const std::int64_t> values);
    /// As integers of 64 bits.
    void integers32(std::string_view path, std::span<const std::int32_t> values);
    void bytes(std::string_view path, std::span<const std::byte> values);

    /// Puts the checkpoint, sealed by a digest of all its bytes, in place of `target`: at once or
    /// not at all, and on the disk when this returns. A temporary TARGET.tmp is used. Throws
    /// OutputError (file and the system's reason); the earlier file is then as it was. May be
    /// called again; nothing can be added then (std::logic_error).
    void save(const std::filesystem::path& target) const;

  private:
    struct Image;
    std::unique_ptr<Image> image_;
};

/// What a CheckpointWriter saved. The digest is checked before HDF5 sees a byte, so that a file is
/// whole or refused.
class CheckpointReader {
  public:
    /// Throws InputError, one line: not there, not a checkpoint, cut short or damaged, of another
    /// format.
    explicit CheckpointReader(const std::filesystem::path& path);
    ~CheckpointReader();

    bool has(std::string_view path) const;

    // Each throws InputError when the checkpoint holds no such thing at `path`.
    std::string text(std::string_view path) const;
    std::vector<double> numbers(std::string_view path) const;  ///< row after row
    std::size_t columns(std::string_view path) const;          ///< of numbers
    std::vector<std::int64_t> integers(std::string_view path) const;
    std::vector<std::byte> bytes(std::string_view path) const;

  private:
    struct Image;
    std::unique_ptr<Image> image_;
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace spam {

/// The seal that follows contents in a file, by which it is known to be whole, 56 bytes in every format:
///     "SPAMckpt" | format | length of what is sealed | SHA-256 of all before
/// with numbers of 64 bits, little-endian. What follows an HDF5 file does not disturb its readers.
using Seal = std::array<std::byte, 56>;
Seal seal_of(std::span<const std::byte> contents);

/// The contents of a sealed file without the seal. Throws InputError, one line: not there, not a
/// file, without a seal, of another format, damaged. Never waits (for a pipe), and reads a large
/// file only if its end looks right.
std::vector<std::byte> read_sealed(const std::filesystem::path& path);

}  // namespace spam

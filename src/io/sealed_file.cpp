// SPDX-License-Identifier: GPL-3.0-or-later
#include "sealed_file.hpp"

#include "file_descriptor.hpp"
#include <spam/core/error.hpp>

#include <fmt/format.h>
#include <nettle/sha2.h>
#include <nettle/version.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string_view>
#include <tuple>

namespace spam {
namespace {

constexpr std::string_view magic = "SPAMckpt";
constexpr std::uint64_t format = 2;
constexpr std::size_t digest_size = 32;
constexpr std::size_t seal_size = std::tuple_size_v<Seal>;
static_assert(seal_size == magic.size() + 8 + 8 + digest_size);

constexpr const char* advice = "a run keeps two checkpoints, try the other";

using Digest = std::array<std::byte, digest_size>;

/// Of one after the other. Nettle has the processor's SHA instructions and takes .2 ms to load, where OpenSSL, which
/// the package of HDF5 brings along, takes 4 ms and more at the first use: a sixth of a short run.
Digest sha256(std::initializer_list<std::span<const std::byte>> pieces) {
    sha256_ctx context;
    sha256_init(&context);
    for (const auto piece : pieces)
        sha256_update(&context, piece.size(), reinterpret_cast<const std::uint8_t*>(piece.data()));
    Digest digest;
    auto* const out = reinterpret_cast<std::uint8_t*>(digest.data());
#if NETTLE_VERSION_MAJOR >= 4
    sha256_digest(&context, out);
#else
    sha256_digest(&context, digest.size(), out);
#endif
    return digest;
}

void put_number(std::byte* bytes, std::uint64_t number) {
    for (int k = 0; k < 8; ++k) bytes[k] = static_cast<std::byte>(number >> (8 * k));
}

std::uint64_t number_at(const std::byte* bytes) {
    std::uint64_t number = 0;
    for (int k = 0; k < 8; ++k) number |= static_cast<std::uint64_t>(bytes[k]) << (8 * k);
    return number;
}

std::uint64_t size_of(const FileDescriptor& file, const std::string& name) {
    struct stat status;
    if (::fstat(file.get(), &status) != 0)
        throw InputError(fmt::format("checkpoint '{}': {}", name, system_reason()));
    return static_cast<std::uint64_t>(status.st_size);
}

void read_at(const FileDescriptor& file, std::uint64_t offset, std::span<std::byte> bytes,
             const std::string& name) {
    const std::size_t got = file.read_at(offset, bytes);
    if (got != bytes.size())
        throw InputError(fmt::format("checkpoint '{}' cannot be read: {}; {}", name,
                                     errno != 0 ? system_reason() : "it became shorter", advice));
}

/// What the seal says without a look at the contents.
void check_form(std::span<const std::byte> seal, std::uint64_t length, const std::string& name) {
    if (std::memcmp(seal.data(), magic.data(), magic.size()) != 0)
        throw InputError(
            fmt::format("'{}' is not a SPAM checkpoint: its end bears no seal (a file "
                        "of another program, or a checkpoint cut short); {}",
                        name, advice));
    const std::uint64_t its_format = number_at(&seal[magic.size()]);
    if (its_format != format)
        throw InputError(fmt::format(
            "checkpoint '{}' has format {}, and this version of SPAM reads format {} only; use the "
            "version that wrote it",
            name, its_format, format));
    const std::uint64_t its_length = number_at(&seal[magic.size() + 8]);
    if (its_length != length)
        throw InputError(
            fmt::format("checkpoint '{}' is damaged: {} bytes where its seal says {}; {}", name,
                        length, its_length, advice));
}

}  // namespace

Seal seal_of(std::span<const std::byte> contents) {
    Seal seal{};
    std::memcpy(seal.data(), magic.data(), magic.size());
    put_number(&seal[magic.size()], format);
    put_number(&seal[magic.size() + 8], contents.size());
    const Digest digest = sha256({contents, std::span(seal).first<seal_size - digest_size>()});
    std::memcpy(&seal[seal_size - digest_size], digest.data(), digest_size);
    return seal;
}

std::vector<std::byte> read_sealed(const std::filesystem::path& path) {
    const std::string name = path.string();
    const FileDescriptor file = FileDescriptor::open_regular(path);
    if (!file.is_open() && errno == EISDIR)
        throw InputError(fmt::format(
            "checkpoint '{}' is a folder; name a file in it, e.g. checkpoint_0.h5", name));
    if (!file.is_open())
        throw InputError(
            fmt::format("checkpoint '{}'{}; give a result folder, or a checkpoint in it", name,
                        errno == ESPIPE ? " is not a regular file" : ": " + system_reason()));
    const std::uint64_t size = size_of(file, name);
    if (size < seal_size)
        throw InputError(
            fmt::format("'{}' is not a SPAM checkpoint: {} bytes only (a file of "
                        "another program, or a checkpoint cut short); {}",
                        name, size, advice));
    std::array<std::byte, seal_size> end;
    read_at(file, size - seal_size, end, name);
    check_form(end, size - seal_size, name);

    std::vector<std::byte> contents(size);
    read_at(file, 0, contents, name);
    const std::span all(contents);
    check_form(all.last(seal_size), size - seal_size, name);
    const Digest digest = sha256({all.first(size - digest_size)});
    if (std::memcmp(digest.data(), all.last(digest_size).data(), digest_size) != 0)
        throw InputError(
            fmt::format("checkpoint '{}' is damaged: its SHA-256 is not the one of its seal; {}",
                        name, advice));
    contents.resize(size - seal_size);
    return contents;
}

}  // namespace spam

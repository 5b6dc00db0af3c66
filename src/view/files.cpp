// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.hpp"

#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace spam::view {
namespace fs = std::filesystem;

namespace {

/// The folder that would hold it, and the name under which it is written first.
fs::path part_of(const fs::path& path) {
    fs::path part = path;
    part += ".part";
    return part;
}

std::string shown(const fs::path& path) { return one_line(path.string()); }

}  // namespace

std::string contents(const fs::path& path) {
    std::error_code error;
    const auto size = fs::is_regular_file(path, error) ? fs::file_size(path, error) : 0;
    std::ifstream in(path, std::ios::binary);
    std::string text(size, '\0');
    if (!error && in.is_open() && fs::is_regular_file(path, error)) {
        in.read(text.data(), static_cast<std::streamsize>(size));
        if (in.gcount() == static_cast<std::streamsize>(size)) return text;
    }
    throw InputError(fmt::format("RESULTS: {} cannot be read ({})", shown(path),
                                 error ? error.message() : "it is no file that may be read"));
}

void check_writable(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error))
        throw InputError(fmt::format("--out: {} is a folder; name a file", shown(path)));
    if (fs::exists(path, error)) {
        std::string begin(page_mark.size(), '\0');
        std::ifstream in(path, std::ios::binary);
        in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
        if (begin != page_mark)
            throw InputError(fmt::format(
                "--out: {} exists and is no page of spam view; name another file", shown(path)));
    }
    const fs::path part = part_of(path);
    errno = 0;
    const bool possible = std::ofstream(part, std::ios::binary).is_open();
    const int reason = errno;
    if (!possible)
        throw InputError(
            fmt::format("--out: cannot write {} ({}); name a file elsewhere: --out FILE",
                        shown(path), std::strerror(reason)));
    fs::remove(part, error);
}

void write_file(const fs::path& path, std::string_view text) {
    const fs::path part = part_of(path);
    std::error_code error;
    {
        std::ofstream out(part, std::ios::binary);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        out.flush();
        if (!out) error = std::make_error_code(std::errc::io_error);
    }
    if (!error) fs::rename(part, path, error);
    if (!error) return;
    const std::string why = error.message();
    fs::remove(part, error);
    throw OutputError(fmt::format("cannot write {} ({})", shown(path), why));
}

}  // namespace spam::view

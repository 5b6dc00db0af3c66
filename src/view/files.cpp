// SPDX-License-Identifier: GPL-3.0-or-later
#include "files.hpp"

#include "../io/file_descriptor.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <span>
#include <utility>

namespace spam::view {
namespace fs = std::filesystem;

namespace {

/// A new, empty file beside the page, of a name that nothing has; closed where it cannot be.
std::pair<FileDescriptor, fs::path> new_part(const fs::path& page) {
    for (int k = 0;; ++k) {
        fs::path part = page;
        part += fmt::format(".part-{}-{}", ::getpid(), k);
        auto file = FileDescriptor::create(part);
        if (file.is_open() || errno != EEXIST) return {std::move(file), part};
    }
}

std::string shown(const fs::path& path) { return one_line(path.string()); }

}  // namespace

std::string contents(const fs::path& path) {
    try {
        return contents_of_file(path);
    } catch (const InputError& refusal) {
        throw InputError(
            fmt::format("RESULTS: {} cannot be read ({})", shown(path), refusal.what()));
    }
}

void check_writable(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error))
        throw InputError(fmt::format("--out: {} is a folder; name a file", shown(path)));
    if (fs::exists(path, error)) {
        std::string begin(page_mark.size(), '\0');
        FileDescriptor::open_regular(path).read_at(0, std::as_writable_bytes(std::span(begin)));
        if (begin != page_mark)
            throw InputError(fmt::format(
                "--out: {} exists and is no page of spam view; name another file", shown(path)));
    }
    const auto [file, part] = new_part(path);
    if (!file.is_open())
        throw InputError(
            fmt::format("--out: cannot write {} ({}); name a file elsewhere: --out FILE",
                        shown(path), system_reason()));
    fs::remove(part, error);
}

void write_file(const fs::path& path, std::string_view text) {
    auto [file, part] = new_part(path);
    const bool made = file.is_open();
    const bool written = made && file.write(std::as_bytes(std::span(text))) && file.close();
    if (written && std::rename(part.c_str(), path.c_str()) == 0) return;
    const std::string why = system_reason();
    std::error_code ignored;
    if (made) fs::remove(part, ignored);
    throw OutputError(fmt::format("cannot write {} ({})", shown(path), why));
}

}  // namespace spam::view

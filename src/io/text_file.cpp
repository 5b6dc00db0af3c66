// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/io/text_file.hpp>

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>

namespace spam {

std::string text_file(const std::string& path, const std::string& option,
                      const std::string& expected) {
    constexpr std::size_t largest = 16 << 20;  // nothing that is typed is longer
    std::error_code error;
    std::ifstream in(path, std::ios::binary);
    if (!in || std::filesystem::is_directory(path, error))
        throw InputError(fmt::format("{}: '{}' cannot be read; give {}", option, path, expected));
    std::string text;
    for (std::array<char, 4096> part; in;) {
        in.read(part.data(), part.size());
        text.append(part.data(), static_cast<std::size_t>(in.gcount()));
        if (text.size() > largest)
            throw InputError(
                fmt::format("{}: '{}' is longer than 16 MiB; give {}", option, path, expected));
    }
    if (in.bad())
        throw InputError(
            fmt::format("{}: '{}' cannot be read to its end; give {}", option, path, expected));
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // spreadsheets begin UTF-8 so
    return text;
}

}  // namespace spam

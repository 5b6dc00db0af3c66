// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>
#include <vector>

namespace spam {
namespace {

/// Levenshtein distance, letters compared without case.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t change = diagonal + (lower(a[i]) != lower(b[j]) ? 1 : 0);
            diagonal = row[j + 1];
            row[j + 1] = std::min({change, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

template <class Number>
std::optional<Number> read_whole_word(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(word.substr(1).starts_with('-') ? 0 : 1);
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    return value;
}

}  // namespace

std::optional<double> number_in(std::string_view word) {
    const auto value = read_whole_word<double>(word);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<int> whole_number_in(std::string_view word) { return read_whole_word<int>(word); }

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
    if (word.size() > 100) return {};  // no user's slip
    // A candidate that contains the word is what was meant, however much longer it is.
    for (const auto& candidate : candidates)
        if (word.size() >= 3 && candidate.find(word) != std::string::npos) return candidate;
    const auto it = std::min_element(
        candidates.begin(), candidates.end(),
        [word](const auto& a, const auto& b) { return distance(word, a) < distance(word, b); });
    // More changes make another word of it; two letters exchanged are two.
    const std::size_t too_far = word.size() < 4 ? 1 : std::max<std::size_t>(2, word.size() / 3);
    return it == candidates.end() || distance(word, *it) > too_far ? std::string{} : *it;
}

std::string suggestion(std::string_view word, std::span<const std::string> candidates,
                       std::string_view prefix) {
    const std::string found = nearest(word, candidates);
    return found.empty() ? std::string(".") : fmt::format("; did you mean {}{}?", prefix, found);
}

std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        if (line.size() > 1000) return line + " ...";
        const auto code = static_cast<unsigned char>(c);
        if (c == '\n')
            line += "\\n";
        else if (code < 0x20 || code == 0x7f)
            line += fmt::format("\\x{:02x}", code);
        else
            line += c;
    }
    return line;
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtp_file.hpp"

#include "files.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <iterator>

namespace spam::view {
namespace {

static_assert(std::endian::native == std::endian::little, "snapshots are read byte by byte");

constexpr std::string_view spaces = " \t\r\n";

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; (at = text.find_first_not_of(spaces, at)) != text.npos;) {
        const std::size_t end = std::min(text.find_first_of(spaces, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

/// name="value" pairs of a tag; false where it is something else.
bool read_attributes(std::string_view text,
                     std::map<std::string, std::string, std::less<>>& attributes) {
    for (std::size_t at = 0; (at = text.find_first_not_of(spaces, at)) != text.npos;) {
        const std::size_t equal = text.find("=\"", at);
        if (equal == text.npos) return false;
        const std::size_t end = text.find('"', equal + 2);
        if (end == text.npos) return false;
        attributes.emplace(text.substr(at, equal - at), text.substr(equal + 2, end - equal - 2));
        at = end + 1;
    }
    return true;
}

}  // namespace

VtpFile::VtpFile(std::filesystem::path path) : path_(std::move(path)), bytes_(contents(path_)) {
    // The numbers are no XML: the head ends before any reader of XML may see them.
    constexpr std::string_view begin = "<AppendedData encoding=\"raw\">", end = "</VTKFile>";
    const std::string_view all(bytes_);
    const std::size_t cut = all.substr(0, std::size_t{1} << 20).find(begin);
    if (cut == all.npos) refuse("it has no appended raw numbers, or ends before them");
    tail_ = all.find('_', cut + begin.size());
    if (tail_ == all.npos || all.find_last_not_of(spaces) == all.npos ||
        !all.substr(0, all.find_last_not_of(spaces) + 1).ends_with(end))
        refuse("it ends too early");
    ++tail_;
    read_head(all.substr(0, cut));
    if (!timed_) refuse("it has no TimeValue");
}

void VtpFile::refuse(const std::string& reason) const {
    throw InputError(
        fmt::format("RESULTS: {} is damaged, or no snapshot of spam: {}; run the problem again",
                    one_line(path_.string()), one_line(reason.substr(0, 120))));
}

void VtpFile::read_head(std::string_view head) {
    std::string section;
    bool piece = false;
    for (std::size_t at = 0; (at = head.find('<', at)) != head.npos;) {
        const std::size_t end = head.find('>', at);
        if (end == head.npos) refuse("a tag does not end");
        std::string_view tag = head.substr(at + 1, end - at - 1);
        at = end + 1;
        if (tag.starts_with('?')) continue;
        if (tag.starts_with('/')) {
            if (tag.substr(1) == section) section.clear();
            continue;
        }
        const bool closed = tag.ends_with('/');
        if (closed) tag.remove_suffix(1);
        const std::size_t name_end = std::min(tag.find_first_of(spaces), tag.size());
        const std::string name(tag.substr(0, name_end));
        Attributes attributes;
        if (!read_attributes(tag.substr(name_end), attributes))
            refuse(fmt::format("the tag {} is not as it should be", name));
        const std::string_view text =
            closed ? std::string_view{} : head.substr(at, head.find('<', at) - at);
        if (name == "DataArray" || name == "VTKFile" || name == "Piece")
            read_element(name, attributes, text, section);
        else if (!closed && name != "PolyData" && name != "InformationKey")
            section = name;
        piece = piece || name == "Piece";
    }
    if (!piece) refuse("it has no piece of PolyData");
}

void VtpFile::read_element(const std::string& name, const Attributes& attributes,
                           std::string_view text, const std::string& section) {
    const auto is = [&](std::string_view key, std::string_view value) {
        const auto it = attributes.find(key);
        return it != attributes.end() && it->second == value;
    };
    if (name == "VTKFile") {
        if (!is("version", "1.0")) refuse("it is of a format that this spam-view does not know");
        if (!is("type", "PolyData") || !is("byte_order", "LittleEndian") ||
            !is("header_type", "UInt64") || attributes.contains("compressor"))
            refuse("it is not uncompressed little-endian PolyData");
        return;
    }
    if (name == "Piece") {
        points_ = count(attributes, "NumberOfPoints");
        vertices_ = count(attributes, "NumberOfVerts");
        polygons_ = count(attributes, "NumberOfPolys");
        return;
    }
    if (section == "FieldData") return read_field_data(attributes, text);
    const auto label = attributes.find("Name");
    if (label == attributes.end() || !is("format", "appended")) refuse("an array is not appended");
    const bool whole = is("type", "Int64");
    if (!whole && !is("type", "Float64"))
        refuse(fmt::format("{} is of no type that spam writes", label->second));
    arrays_.push_back({section, label->second, whole, count(attributes, "NumberOfComponents"),
                       count(attributes, "offset")});
}

void VtpFile::read_field_data(const Attributes& attributes, std::string_view text) {
    const auto label = attributes.find("Name");
    if (label == attributes.end()) return;
    std::vector<double> values;
    for (const std::string_view word : words_of(text))
        if (const auto value = number_in(word))
            values.push_back(*value);
        else
            refuse(fmt::format("{} of the field data is no finite number", label->second));
    const std::string& name = label->second;
    const bool box = name == "box_low" || name == "box_high" || name == "periodic";
    if ((box && values.size() != 3) || (name == "TimeValue" && values.size() != 1))
        refuse(fmt::format("{} has {} values", name, values.size()));
    if (name == "TimeValue") {
        time_ = values[0];
        timed_ = true;
    }
    if (name == "box_low") std::copy(values.begin(), values.end(), low_.begin());
    if (name == "box_high") std::copy(values.begin(), values.end(), high_.begin());
    if (name == "periodic")
        std::transform(values.begin(), values.end(), periodic_.begin(),
                       [](double p) { return p != 0.0; });
}

std::size_t VtpFile::count(const Attributes& attributes, std::string_view name) const {
    const auto it = attributes.find(name);
    std::size_t value = 0;
    if (it != attributes.end()) {
        const char* const end = it->second.data() + it->second.size();
        const auto [stop, error] = std::from_chars(it->second.data(), end, value);
        // Nothing that the file holds is more than its bytes: what follows may multiply.
        if (error == std::errc{} && stop == end && value <= bytes_.size()) return value;
    }
    refuse(fmt::format("{} is missing, or no number that the file could hold", name));
}

const VtpFile::Array* VtpFile::find(std::string_view section, std::string_view name) const {
    const auto it = std::find_if(arrays_.begin(), arrays_.end(), [&](const Array& array) {
        return array.section == section && array.name == name;
    });
    return it == arrays_.end() ? nullptr : &*it;
}

template <class Number>
std::vector<Number> VtpFile::numbers(const Array& array, std::size_t tuples) const {
    static_assert(sizeof(Number) == 8);
    const std::size_t left = bytes_.size() - tail_;
    std::uint64_t length = 0;
    if (array.offset > left || left - array.offset < sizeof length)
        refuse(fmt::format("{} begins behind its end", array.name));
    const char* const begin = bytes_.data() + tail_ + array.offset;
    std::memcpy(&length, begin, sizeof length);
    const std::size_t expected = array.components * tuples * sizeof(Number);
    if (array.components == 0 || array.components > 64 || length != expected ||
        left - array.offset - sizeof length < expected)
        refuse(fmt::format("{} has {} bytes, and should have {}", array.name, length, expected));
    std::vector<Number> result(array.components * tuples);
    if (!result.empty()) std::memcpy(result.data(), begin + sizeof length, expected);
    return result;
}

std::vector<double> VtpFile::reals(const Array& array, std::size_t tuples) const {
    if (!array.whole_numbers) return numbers<double>(array, tuples);
    const auto whole = numbers<std::int64_t>(array, tuples);
    std::vector<double> result;
    std::transform(whole.begin(), whole.end(), std::back_inserter(result),
                   [](std::int64_t value) { return static_cast<double>(value); });
    return result;
}

std::vector<std::int64_t> VtpFile::integers(const Array& array, std::size_t tuples) const {
    if (!array.whole_numbers) refuse(fmt::format("{} should be whole numbers", array.name));
    return numbers<std::int64_t>(array, tuples);
}

}  // namespace spam::view

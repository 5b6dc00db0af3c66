// SPDX-License-Identifier: GPL-3.0-or-later
#include "payload.hpp"

#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace spam::view {
using nlohmann::json;

namespace {

/// Single precision looks better under the magnifying glass, where it costs nothing that matters.
constexpr std::size_t small_page = 800'000;
constexpr std::size_t most_rows = 4000;
constexpr std::size_t in_description = 200;  ///< bytes that say what an array is, at most

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

bool is_kept(std::size_t k, std::size_t count, std::size_t every) {
    return k % every == 0 || k + 1 == count;
}

bool moves(const FieldArray& field) { return field.name == "position" || field.name == "velocity"; }

/// The smallest and the largest finite number, 0 where there is none.
std::pair<float, float> extremes(const float* begin, std::size_t n) {
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (const float* v = begin; v != begin + n; ++v)
        if (std::isfinite(*v)) {
            low = std::min(low, *v);
            high = std::max(high, *v);
        }
    return low > high ? std::pair{0.0F, 0.0F} : std::pair{low, high};
}

/// Adds arrays to a payload; one that is the same as the last of its key is not added again.
class Blocks {
  public:
    explicit Blocks(Payload& payload) : payload_(payload) {
        payload_.description["arrays"] = json::array();
    }

    std::size_t add(const std::string& key, const FieldArray& field, int bytes) {
        return once(key, bytes_of(field.values), [&] { return encoded(field, bytes); });
    }
    std::size_t add(const std::string& key, const std::vector<std::uint32_t>& numbers) {
        const std::string raw = bytes_of(numbers);
        return once(key, raw, [&] { return json{{"type", "u4"}, {"c", 1}, {"b", block(raw)}}; });
    }
    std::size_t add(const std::vector<double>& numbers) {
        payload_.description["arrays"].push_back(
            {{"type", "f8"}, {"c", 1}, {"b", block(bytes_of(numbers))}});
        return payload_.description["arrays"].size() - 1;
    }

  private:
    template <class Make>
    std::size_t once(const std::string& key, std::string raw, const Make& make) {
        const auto it = last_.find(key);
        if (it != last_.end() && it->second.first == raw) return it->second.second;
        payload_.description["arrays"].push_back(make());
        const std::size_t number = payload_.description["arrays"].size() - 1;
        last_[key] = {std::move(raw), number};
        return number;
    }

    std::size_t block(const std::string& bytes) {
        payload_.blocks.push_back(base64(bytes));
        return payload_.blocks.size() - 1;
    }

    json encoded(const FieldArray& field, int bytes) {
        const std::size_t n = field.values.size() / field.components;
        json about{{"c", field.components}, {"n", n}};
        const auto [least, most] = extremes(field.values.data(), field.values.size());
        if (least == most && std::all_of(field.values.begin(), field.values.end(),
                                         [&, low = least](float v) { return v == low; })) {
            about.update({{"type", "c"}, {"low", least}});
            return about;
        }
        if (bytes == 4) {
            about.update({{"type", "f4"}, {"b", block(bytes_of(field.values))}});
            return about;
        }
        std::string packed;
        std::vector<double> lows, steps;
        const unsigned nothing = bytes == 2 ? 0xFFFFU : 0xFFU;  // where there is no finite number
        for (std::size_t c = 0; c < field.components; ++c) {
            const float* const begin = field.values.data() + c * n;
            const auto [low, high] = extremes(begin, n);
            const double step = (static_cast<double>(high) - low) / (nothing - 1);
            for (const float* v = begin; v != begin + n; ++v) {
                const unsigned q =
                    !std::isfinite(*v) ? nothing
                    : step > 0.0
                        ? static_cast<unsigned>(std::lround((static_cast<double>(*v) - low) / step))
                        : 0U;
                packed.push_back(static_cast<char>(q & 0xFFU));
                if (bytes == 2) packed.push_back(static_cast<char>(q >> 8U));
            }
            lows.push_back(low);
            steps.push_back(step);
        }
        about.update({{"type", bytes == 2 ? "u2" : "u1"},
                      {"low", lows},
                      {"step", steps},
                      {"b", block(packed)}});
        return about;
    }

    Payload& payload_;
    std::map<std::string, std::pair<std::string, std::size_t>> last_;
};

json table_of(const Table& table, Blocks& blocks) {
    if (table.names.empty()) return nullptr;
    const std::size_t rows = table.columns[0].size();
    const std::size_t every = (rows + most_rows - 1) / std::max<std::size_t>(most_rows, 1);
    json about{{"names", table.names}, {"rows", rows}, {"every", std::max<std::size_t>(every, 1)}};
    for (const auto& column : table.columns) {
        std::vector<double> kept;
        for (std::size_t k = 0; k < rows; ++k)
            if (is_kept(k, rows, std::max<std::size_t>(every, 1))) kept.push_back(column[k]);
        about["columns"].push_back(blocks.add(kept));
    }
    return about;
}

json snapshot_of(const Snapshot& snapshot, const Thinning& thinning, Blocks& blocks,
                 const std::string& key) {
    json about{{"t", snapshot.t},
               {"low", snapshot.low},
               {"high", snapshot.high},
               {"periodic", snapshot.periodic},
               {"n", snapshot.id.size()}};
    about["id"] = blocks.add(key + "id", snapshot.id);
    for (const FieldArray& field : snapshot.points)
        about["points"][field.name] =
            blocks.add(key + "points " + field.name, field,
                       moves(field) ? thinning.bytes : thinning.field_bytes);
    if (snapshot.corners.empty()) return about;
    about["corners"] = blocks.add(key + "corners", snapshot.corners);
    about["cells"] = json::object();
    for (const FieldArray& field : snapshot.cells)
        about["cells"][field.name] =
            blocks.add(key + "cells " + field.name, field, thinning.field_bytes);
    return about;
}

json text_of(const Results& results) {
    return {{"problem", results.problem},
            {"version", results.version},
            {"options", results.options},
            {"dimensions", results.dimensions},
            {"checks", results.checks}};
}

}  // namespace

std::string base64(const std::string& bytes) {
    static constexpr char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8U |
                    (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (unsigned k = 0; k < 4; ++k)
            text.push_back(i + k > bytes.size() ? '=' : letters[group >> (18U - 6U * k) & 63U]);
    }
    return text;
}

std::string in_page(const json& value) {
    std::string text;
    for (const char c : value.dump(-1, ' ', true, json::error_handler_t::replace))
        if (c == '<')
            text += "\\u003c";
        else
            text += c;
    return text;
}

std::string Thinning::in_words() const {
    std::string words = bytes == 4 ? "numbers in single precision"
                                   : "positions and velocities in 16 bits between their extremes";
    if (bytes != 4) words += fmt::format(", fields in {} bits", 8 * field_bytes);
    if (every > 1) words += fmt::format("; every {}. snapshot and the last", every);
    return words;
}

std::size_t bytes_of_text(const Results& results) {
    json text = text_of(results);
    for (const Case& one : results.cases)
        text["cases"].push_back({one.name, one.statistics, one.invariants.names});
    return in_page(text).size();
}

std::size_t bytes_in_page(const Results& results, const Thinning& thinning) {
    std::size_t bytes = 0;
    for (const Case& one : results.cases) {
        const Snapshot* before = nullptr;
        for (std::size_t k = 0; k < one.snapshots.size(); ++k) {
            if (!is_kept(k, one.snapshots.size(), thinning.every)) continue;
            const Snapshot& now = one.snapshots[k];
            const auto count = [&](const std::vector<FieldArray>& fields,
                                   const std::vector<FieldArray>* old) {
                for (std::size_t f = 0; f < fields.size(); ++f) {
                    const auto& v = fields[f].values;
                    const bool same = old != nullptr && f < old->size() && (*old)[f].values == v;
                    const bool constant =
                        !v.empty() &&
                        std::all_of(v.begin(), v.end(), [&](float x) { return x == v[0]; });
                    const int size = moves(fields[f]) ? thinning.bytes : thinning.field_bytes;
                    if (!same) bytes += in_description;
                    if (!same && !constant) bytes += v.size() * static_cast<std::size_t>(size);
                }
            };
            count(now.points, before != nullptr ? &before->points : nullptr);
            count(now.cells, before != nullptr ? &before->cells : nullptr);
            if (before == nullptr || before->id != now.id) bytes += 4 * now.id.size();
            if (before == nullptr || before->corners != now.corners)
                bytes += 4 * now.corners.size();
            bytes += 2 * in_description;
            before = &now;
        }
        const auto& table = one.invariants;
        if (!table.columns.empty())
            bytes += 8 * table.columns.size() * std::min(table.columns[0].size(), most_rows);
    }
    return bytes / 3 * 4;
}

Thinning thinned_to(const Results& results, std::size_t most) {
    std::size_t longest = 0;
    for (const Case& one : results.cases) longest = std::max(longest, one.snapshots.size());
    for (Thinning thinning : {Thinning{4, 4, 1}, {2, 2, 1}, {2, 1, 1}})
        if (bytes_in_page(results, thinning) <=
            (thinning.bytes == 4 ? std::min(most, small_page) : most))
            return thinning;
    std::size_t bytes = 0;
    for (Thinning thinning{2, 1, 2}; thinning.every <= longest; ++thinning.every)
        if ((bytes = bytes_in_page(results, thinning)) <= most) return thinning;
    bytes = bytes_in_page(results, {2, 1, std::max<std::size_t>(longest, 1)});
    throw InputError(
        fmt::format("--max-mb: the first and the last snapshot take {:.1f} MB; allow as much",
                    std::ceil(static_cast<double>(bytes) / 1e5 + 3.0) / 10.0));
}

Payload make_payload(const Results& results, const Thinning& thinning) {
    Payload payload;
    payload.thinning = thinning;
    json& about = payload.description;
    about = text_of(results);
    about["thinning"] = thinning.in_words();
    Blocks blocks(payload);
    for (const Case& one : results.cases) {
        json part{
            {"name", one.name}, {"statistics", one.statistics}, {"written", one.snapshots.size()}};
        part["invariants"] = table_of(one.invariants, blocks);
        for (std::size_t k = 0; k < one.snapshots.size(); ++k)
            if (is_kept(k, one.snapshots.size(), thinning.every))
                part["snapshots"].push_back(
                    snapshot_of(one.snapshots[k], thinning, blocks, one.name + "/"));
        about["cases"].push_back(std::move(part));
    }
    return payload;
}

}  // namespace spam::view

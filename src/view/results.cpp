// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.hpp"

#include "../io/file_descriptor.hpp"
#include "files.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace spam::view {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

std::string shown(const fs::path& path) { return one_line(path.string()); }

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
    throw InputError(fmt::format("RESULTS: {}: {}", shown(path), reason));
}

/// Null where the file does not exist.
json read_json(const fs::path& path) {
    if (!is_something(path)) return nullptr;
    // What goes through a value calls itself at every level.
    const auto is_flat = [&](int depth, json::parse_event_t, const json&) {
        if (depth > 50) refuse(path, "is damaged, it is nested too deeply; run the problem again");
        return true;
    };
    json value = json::parse(contents(path), is_flat, false);
    if (value.is_discarded()) refuse(path, "is damaged, it is no JSON; run the problem again");
    return value;
}

/// Null likewise.
json read_statistics(const fs::path& path) {
    json statistics = read_json(path);
    if (!statistics.is_null() && !statistics.is_object())
        refuse(path, "is damaged, it holds no names; run the problem again");
    for (const char* name : {"problem", "version"})
        if (statistics.contains(name) && !statistics[name].is_string())
            refuse(path, fmt::format("is damaged, {} is no text; run the problem again", name));
    return statistics;
}

/// Times and files that snapshots.pvd lists.
std::vector<std::string> listed(const fs::path& path) {
    const std::string text = contents(path);
    if (text.find("</VTKFile>") == text.npos)
        refuse(path, "is no list of snapshots, or ends too early; run the problem again");
    std::vector<std::string> names;
    for (std::size_t at = 0; (at = text.find(" file=\"", at)) != text.npos;) {
        at += 7;
        const std::size_t end = std::min(text.find('"', at), text.size());
        names.push_back(text.substr(at, end - at));
        // A list from elsewhere must not lead to files elsewhere.
        if (fs::path(names.back()).filename() != names.back() || !names.back().ends_with(".vtp"))
            refuse(path, fmt::format("lists '{}', which is no snapshot beside it",
                                     one_line(names.back().substr(0, 60))));
    }
    return names;
}

Case read_case(const fs::path& folder, std::string name) {
    Case one{std::move(name), {}, {}, read_statistics(folder / "statistics.json")};
    for (const std::string& file : listed(folder / "snapshots.pvd")) {
        one.snapshots.push_back(read_snapshot(folder / file));
        const auto& all = one.snapshots;
        if (all.size() > 1 && all.back().t <= all[all.size() - 2].t)
            refuse(folder / file,
                   "is not later than the snapshot before it; run the problem again");
    }
    if (is_something(folder / "invariants.csv"))
        one.invariants = read_table(folder / "invariants.csv");
    return one;
}

/// Folders with a list of snapshots: the results themselves, or folders inside, two levels deep at most.
std::vector<fs::path> case_folders(const fs::path& folder) {
    std::vector<fs::path> found;
    if (is_something(folder / "snapshots.pvd")) found.push_back(folder);
    std::error_code error, ignored;
    auto it = fs::recursive_directory_iterator(folder, error);
    for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        if (it.depth() > 1) it.disable_recursion_pending();
        if (it->is_directory(ignored) && is_something(it->path() / "snapshots.pvd"))
            found.push_back(it->path());
    }
    if (error) refuse(folder, fmt::format("cannot be read ({})", error.message()));
    std::sort(found.begin(), found.end());
    return found;
}

int dimensions_of(const std::vector<Case>& cases) {
    int dimensions = 1;
    for (const Case& one : cases)
        for (const Snapshot& snapshot : one.snapshots)
            for (int a = dimensions; a < 3; ++a) {
                const auto axis = static_cast<std::size_t>(a);
                const std::size_t n = snapshot.id.size();
                const auto begin = snapshot.points[0].values.begin();
                const auto at = [&](std::size_t k) {
                    return begin + static_cast<std::ptrdiff_t>(k * n);
                };
                if (snapshot.high[axis] > snapshot.low[axis] ||
                    std::any_of(at(axis), at(axis + 1), [](float x) { return x != 0.0F; }))
                    dimensions = a + 1;
            }
    return dimensions;
}

/// The components that a space of so many dimensions has: of a vector, and of a symmetric tensor of 9 the
/// upper triangle row by row.
void keep_components(FieldArray& field, std::size_t n, int dimensions) {
    std::vector<std::size_t> kept;
    const auto dims = static_cast<std::size_t>(dimensions);
    if (field.components == 3)
        for (std::size_t a = 0; a < dims; ++a) kept.push_back(a);
    else if (field.components == 9)
        for (std::size_t a = 0; a < dims; ++a)
            for (std::size_t b = a; b < dims; ++b) kept.push_back(3 * a + b);
    else
        return;
    for (std::size_t k = 0; k < kept.size(); ++k)
        std::copy_n(field.values.begin() + static_cast<std::ptrdiff_t>(kept[k] * n), n,
                    field.values.begin() + static_cast<std::ptrdiff_t>(k * n));
    field.values.resize(kept.size() * n);
    field.components = kept.size();
}

/// Of a text that is shown as it is.
std::string beginning(std::string text) {
    constexpr std::size_t most = 50'000;
    if (text.size() <= most) return text;
    return text.substr(0, most) + fmt::format("\n... ({} bytes in all)\n", text.size());
}

bool is_check(const json& check) {
    return check.is_object() && check.contains("name") && check["name"].is_string() &&
           check.contains("value");
}

}  // namespace

Results read_results(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error))
        refuse(folder, fs::exists(folder, error) ? "is no folder; name the result folder of a run"
                                                 : "there is no such folder");
    const auto folders = case_folders(folder);
    if (folders.empty()) {
        const bool ours = fs::exists(folder / "case.toml", error);
        refuse(
            folder,
            fs::is_empty(folder, error) ? "is empty; name the result folder of a run"
            : ours
                ? "has no snapshots (snapshots.pvd); this run wrote none, or has not come to its first"
                : "is no result folder of spam: it has neither case.toml nor snapshots.pvd");
    }
    Results results;
    for (const fs::path& one : folders)
        results.cases.push_back(
            read_case(one, one == folder ? "" : one.lexically_relative(folder).generic_string()));
    std::erase_if(results.cases, [](const Case& one) { return one.snapshots.empty(); });
    if (results.cases.empty()) refuse(folder, "has lists of snapshots without any snapshot");
    results.checks = read_json(folder / "result.json");
    if (!results.checks.is_null() &&
        !(results.checks.is_array() &&
          std::all_of(results.checks.begin(), results.checks.end(), is_check)))
        refuse(folder / "result.json", "is no list of checks; run the problem again");
    if (is_something(folder / "case.toml"))
        results.options = beginning(contents(folder / "case.toml"));

    results.problem = folder.filename().empty() ? folder.parent_path().filename().string()
                                                : folder.filename().string();
    for (const Case& one : results.cases) {
        if (one.statistics.is_null()) continue;
        results.problem = one.statistics.value("problem", results.problem);
        results.version = one.statistics.value("version", results.version);
    }
    results.dimensions = dimensions_of(results.cases);
    for (Case& one : results.cases)
        for (Snapshot& snapshot : one.snapshots) {
            for (FieldArray& field : snapshot.points)
                keep_components(field, snapshot.id.size(), results.dimensions);
            for (FieldArray& field : snapshot.cells)
                keep_components(field, snapshot.corners.size() / 4, results.dimensions);
        }
    return results;
}

}  // namespace spam::view

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spam::view {

/// Numbers by particle or by element, component after component: values[c * n + i].
struct FieldArray {
    std::string name;
    std::size_t components;
    std::vector<float> values;
};

/// What a run looked like at one time. Particles are in ascending order of their ids.
struct Snapshot {
    double t = 0.0;
    std::vector<std::uint32_t> id;
    std::vector<FieldArray>
        points;  ///< position and velocity first, as many components as dimensions
    std::vector<std::uint32_t> corners;  ///< 4 of each element: places in the order of ids
    std::vector<FieldArray> cells;       ///< of the elements
    std::array<double, 3> low{}, high{};
    std::array<bool, 3> periodic{};
};

/// A file of columns, invariants.csv.
struct Table {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;  ///< NaN where a cell is empty
};

struct Case {
    std::string name;  ///< of its folder inside the results; empty where there is only one
    std::vector<Snapshot> snapshots;
    Table invariants;           ///< without columns where there is no such file
    nlohmann::json statistics;  ///< null likewise
};

/// All that a page shows of a result folder.
struct Results {
    std::string problem;
    std::string version;
    std::string options;  ///< case.toml
    int dimensions = 0;
    std::vector<Case> cases;
    nlohmann::json checks;  ///< result.json; null where the run has not ended
};

/// Throws InputError: no such folder, nothing in it that can be shown, damaged files.
Results read_results(const std::filesystem::path& folder);

/// One snapshot with all three components of vectors. Throws InputError.
Snapshot read_snapshot(const std::filesystem::path& path);

/// Throws InputError, which names file, line and column. What follows the last end of a line is left out:
/// a run that was killed may have left half a row.
Table read_table(const std::filesystem::path& path);

}  // namespace spam::view

// SPDX-License-Identifier: GPL-3.0-or-later
// A small run as the library writes it: a turning hexagon at some times, with its rows and checks.
#pragma once

#include "support/process.hpp"
#include "support/small_hexagons.hpp"
#include <spam/io/snapshot.hpp>

#include <string>
#include <vector>

namespace spam::test {

/// The system whose snapshots are written, and its states.
struct WrittenRun {
    std::unique_ptr<System> system = smooth_hexagon(3, 0.02);
    std::vector<std::vector<double>> states;

    /// Into `folder`, `count` snapshots at the times 0, 1, ...
    WrittenRun(const std::filesystem::path& folder, int count) {
        const RunFolder run(folder, false);
        SnapshotSeries<2> snapshots(run, *system->model);
        std::vector<double> y = system->y0;
        std::string rows = "t,energy,shape_error\n";
        for (int k = 0; k < count; ++k) {
            for (std::size_t i = 0; i < y.size(); ++i)
                y[i] += 0.01 * std::sin(static_cast<double>(i) + k);
            snapshots.add(k, y);
            states.push_back(y);
            rows += std::to_string(k) + ",0.5,\n";
        }
        run.write("invariants.csv", rows);
        run.write("case.toml", "size = 3\n");
        run.write("statistics.json",
                  R"({"problem": "a </script> <b>problem</b>", "version": "0"})");
        run.write(
            "result.json",
            R"([{"name": "a", "value": 1.0, "expected": 1.0, "tolerance": 0.1, "holds": true}])");
    }
};

}  // namespace spam::test

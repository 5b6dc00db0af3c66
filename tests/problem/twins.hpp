// SPDX-License-Identifier: GPL-3.0-or-later
// Two runs of which one was stopped and restarted: what they left, compared byte for byte.
#pragma once

#include "problem/result_files.hpp"
#include <spam/io/checkpoint_pair.hpp>

#include <boost/test/unit_test.hpp>

namespace spam::test {

using Words = std::vector<std::string>;

inline Words with(Words some, const Words& more) {
    some.insert(some.end(), more.begin(), more.end());
    return some;
}

inline Outcome run_in(const Scratch& folder, const std::string& name, const Words& arguments) {
    return Child(problem(name, arguments), {folder.path()}).finish(Child::Seconds(240));
}

/// 0, or 1 where a run is too short for the problem's own checks.
inline void require_ran(const Outcome& outcome) {
    BOOST_REQUIRE_MESSAGE(outcome.status == 0 || outcome.status == 1, outcome.out << outcome.err);
}

/// What a run leaves: rows, events, configurations; and of the newest checkpoint every field.
inline std::map<std::string, std::string> left_by(const std::filesystem::path& folder) {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const auto name = entry.path().filename().string();
        if (name == "invariants.csv" || name == "events.csv" || name.starts_with("snapshot"))
            all[entry.path().lexically_relative(folder).string()] = contents_of(entry.path());
    }
    const CheckpointReader checkpoint(newest_checkpoint(folder).value());
    for (int k = 0; checkpoint.has("/cases/" + std::to_string(k) + "/label"); ++k)
        for (const char* field : {"position", "velocity", "density", "stress", "energy"}) {
            const std::string path = "/cases/" + std::to_string(k) + "/state/" + field;
            if (!checkpoint.has(path)) continue;
            const auto values = checkpoint.numbers(path);
            all[path].assign(reinterpret_cast<const char*>(values.data()),
                             values.size() * sizeof(double));
        }
    return all;
}

inline void check_same(const std::map<std::string, std::string>& one,
                       const std::map<std::string, std::string>& other) {
    BOOST_TEST(!one.empty());
    for (const auto& [name, contents] : one)
        BOOST_TEST((other.contains(name) && other.at(name) == contents), name << " differs");
    BOOST_TEST(one.size() == other.size());
}

}  // namespace spam::test

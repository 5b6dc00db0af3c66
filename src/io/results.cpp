// SPDX-License-Identifier: GPL-3.0-or-later
#include "spam_version.h"  // written by every build
#include <spam/io/results.hpp>

#include <nlohmann/json.hpp>

#include <cmath>

namespace spam {

bool Check::holds() const {
    return !expected || std::abs(value - *expected) <= tolerance;  // NaN does not hold
}

void write_results(const RunFolder& folder, const std::vector<Check>& checks) {
    auto list = nlohmann::ordered_json::array();
    for (const Check& check : checks) {
        nlohmann::ordered_json item;
        item["name"] = check.name;
        item["value"] = check.value;  // NaN becomes null, which JSON has no other word for
        item["expected"] = check.expected ? nlohmann::ordered_json(*check.expected) : nullptr;
        item["tolerance"] = check.expected ? nlohmann::ordered_json(check.tolerance) : nullptr;
        item["holds"] = check.holds();
        item["source"] = check.source;
        list.push_back(std::move(item));
    }
    folder.write("result.json", list.dump(2) + "\n");
}

void write_statistics(const RunFolder& folder, const RunStatistics& s) {
    nlohmann::ordered_json json;
    json["problem"] = s.problem;
    json["particles"] = s.particles;
    json["t_end"] = s.t_end;
    json["steps"] = s.steps;
    json["rejected_steps"] = s.rejected_steps;
    json["rhs_evaluations"] = s.rhs_evaluations;
    json["events"] = s.events;
    json["wall_seconds"] = s.wall_seconds;
    json["pair_interactions"] = s.pair_interactions;
    json["version"] = version();
    if (!s.stopped.empty()) json["stopped"] = s.stopped;
    folder.write("statistics.json", json.dump(2) + "\n");
}

std::string version() { return SPAM_VERSION; }

}  // namespace spam

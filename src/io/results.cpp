// SPDX-License-Identifier: GPL-3.0-or-later
#include "spam_version.h"  // written by every build
#include <spam/io/results.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace spam {

bool Check::holds() const {
    return std::isfinite(value) && (!expected || std::abs(value - *expected) <= tolerance);
}

void RunStatistics::add(const RunStatistics& other) {
    steps += other.steps;
    rejected_steps += other.rejected_steps;
    rhs_evaluations += other.rhs_evaluations;
    events += other.events;
    wall_seconds += other.wall_seconds;
    pair_interactions += other.pair_interactions;
    ranks.count = std::max(ranks.count, other.ranks.count);
    ranks.exchanges += other.ranks.exchanges;
    ranks.bytes += other.ranks.bytes;
    ranks.seconds += other.ranks.seconds;
    if (stopped.empty()) stopped = other.stopped;
    invariants.clear();
    for (const Limit& limit : other.limited_by) {
        auto known = std::find_if(limited_by.begin(), limited_by.end(),
                                  [&](const Limit& one) { return one.field == limit.field; });
        if (known == limited_by.end()) known = limited_by.insert(known, {limit.field, 0, 0.0});
        known->steps += limit.steps;
        known->error_share += limit.error_share;
    }
}

std::string RunStatistics::limits_in_words() const {
    double total = 0.0;
    for (const Limit& limit : limited_by) total += limit.error_share;
    std::string words;
    for (const Limit& limit : limited_by)
        words += fmt::format("{}{} {} step{} ({:.0f} % of the error)", words.empty() ? "" : ", ",
                             limit.field, limit.steps, limit.steps == 1 ? "" : "s",
                             100.0 * limit.error_share / total);
    return words;
}

void write_results(const RunFolder& folder, const std::vector<Check>& checks) {
    auto list = nlohmann::ordered_json::array();
    for (const Check& check : checks) {
        nlohmann::ordered_json item;
        item["name"] = check.name;
        item["value"] = check.value;  // NaN and infinity become null: JSON has no other word
        item["expected"] = check.expected ? nlohmann::ordered_json(*check.expected) : nullptr;
        item["tolerance"] = check.expected ? nlohmann::ordered_json(check.tolerance) : nullptr;
        item["holds"] = check.holds();
        item["source"] = check.source;
        list.push_back(std::move(item));
    }
    folder.write("result.json", list.dump(2) + "\n");
}

namespace {

/// Promise, scale, limit, change and whether it was kept, by the invariant's name; what is not promised
/// has neither limit nor verdict.
nlohmann::ordered_json json_of(const std::vector<Drift>& drifts) {
    auto all = nlohmann::ordered_json::object();
    for (const Drift& drift : drifts) {
        const bool promised = drift.promise != Promise::not_kept;
        auto& one = all[drift.name];
        one["promise"] = to_string(drift.promise);
        one["scale"] = drift.scale;
        one["limit"] = promised ? nlohmann::ordered_json(drift.limit) : nullptr;
        one["change"] = drift.change;
        one["kept"] = promised ? nlohmann::ordered_json(drift.kept()) : nullptr;
    }
    return all;
}

/// The unit of each kind of number by its name, or what is 1: {"reduced": "the mass of a particle, ..."}.
nlohmann::ordered_json json_of(const UnitNames& units, int dim) {
    auto all = nlohmann::ordered_json::object();
    if (!units.reduced.empty()) all["reduced"] = "1 is " + units.reduced;
    for (const auto& [kind, unit] : units.table(dim)) all[kind] = unit;
    return all;
}

}  // namespace

void write_statistics(const RunFolder& folder, const RunStatistics& s) {
    nlohmann::ordered_json json;
    json["problem"] = s.problem;
    if (s.units.declared()) json["units"] = json_of(s.units, s.dim);
    json["particles"] = s.particles;
    json["t_end"] = s.t_end;
    json["steps"] = s.steps;
    json["rejected_steps"] = s.rejected_steps;
    json["rhs_evaluations"] = s.rhs_evaluations;
    json["events"] = s.events;
    json["wall_seconds"] = s.wall_seconds;
    json["pair_interactions"] = s.pair_interactions;
    if (s.ranks.count > 1)
        json["ranks"] = {{"count", s.ranks.count},
                         {"exchanges", s.ranks.exchanges},
                         {"bytes", s.ranks.bytes},
                         {"exchange_seconds", s.ranks.seconds}};
    if (!s.limited_by.empty()) {
        auto& limits = json["limited_by"] = nlohmann::ordered_json::object();
        for (const auto& limit : s.limited_by) limits[limit.field] = limit.steps;
    }
    if (!s.invariants.empty()) json["invariants"] = json_of(s.invariants);
    json["version"] = version();
    if (!s.stopped.empty()) json["stopped"] = s.stopped;
    folder.write("statistics.json", json.dump(2) + "\n");
}

std::string version() { return SPAM_VERSION; }

}  // namespace spam

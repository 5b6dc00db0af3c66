// SPDX-License-Identifier: GPL-3.0-or-later
#include "problem/found.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace spam::test {

Outcome run_in(const Scratch& folder, const std::string& name, Words arguments) {
    arguments.insert(arguments.end(), {"--out", "out", "--no-plots"});
    return Child(problem(name, arguments), {folder.path()}).finish(Child::Seconds(240));
}

Results::Results(const std::string& name, const Words& arguments, const char* column) {
    const Scratch folder;
    const Outcome outcome = run_in(folder, name, arguments);
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    for (const auto& item : json_of(folder / "out/result.json")) {
        BOOST_TEST(item["holds"] == true, item.dump());
        value[item["name"]] = item["value"];
        if (item["name"] == column && !item["expected"].is_null()) ++claims;
    }
    if (!std::filesystem::exists(folder / "out/invariants.csv")) return;
    const Csv rows(folder / "out/invariants.csv");
    if (std::count(rows.names.begin(), rows.names.end(), column) > 0)
        BOOST_TEST(rows.column(column).back() == value.at(column));
}

}  // namespace spam::test

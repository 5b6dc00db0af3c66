// SPDX-License-Identifier: GPL-3.0-or-later
#include "cost_of_rates.hpp"

#include "file_descriptor.hpp"
#include <spam/core/error.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace spam {

CostOfRates cost_of_rates(const std::filesystem::path& folder) try {
    using nlohmann::json;
    // Nothing of any depth: what destroys a value calls itself at every level.
    const auto flat = [](int depth, json::parse_event_t, const json&) { return depth < 2; };
    const json statistics = json::parse(contents_of_file(folder / "statistics.json"), flat, false);
    const auto number = [&](const char* name) {
        const auto found = statistics.find(name);
        const double value =
            found != statistics.end() && found->is_number() ? found->get<double>() : 0.0;
        return value >= 0.0 && value < 1e18 ? value : 0.0;
    };
    const double evaluations = std::max(number("rhs_evaluations"), 1.0);
    return {number("wall_seconds") / evaluations, number("pair_interactions") / evaluations};
} catch (const InputError&) {
    return {};
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/problem/nearest_state.hpp>
#include <spam/problem/session.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace spam {

/// One of the cases of a problem: what moves, what it is called, and what most problems keep of it. A problem adds
/// what it knows of its own:
///     struct Flow : Variant<2> {
///         ExactFlow exact;
///     };
template <int Dim, class Moving = ParticleModel<Dim>>
struct Variant {
    static constexpr int dim = Dim;

    std::string label{};   ///< of its folder; empty where there is one case only
    std::string prefix{};  ///< of names in result.json
    std::string title{};   ///< in pictures
    std::shared_ptr<Moving> model{};
    std::vector<double> y0{};
    std::vector<NearestState<Dim>> drawn{};  ///< in pictures

    /// Gives it a label, which is its prefix as well.
    void call(const std::string& name) {
        label = name;
        prefix = name + "_";
    }
};

/// Labels of all, in their order.
template <class OneVariant>
std::vector<std::string> labels_of(const std::vector<OneVariant>& all) {
    std::vector<std::string> labels;
    for (const auto& one : all) labels.push_back(one.label);
    return labels;
}

/// Runs all of them, each by the plan that plan_of(one) makes (Session::run_all).
template <class OneVariant, class PlanOf>
std::vector<RunRecord> run_all(Session& session, std::vector<OneVariant>& all,
                               const PlanOf& plan_of) {
    std::vector<Case<OneVariant::dim>> cases;
    for (auto& one : all) cases.push_back({one.model, one.y0, plan_of(one), one.label});
    return session.run_all(std::move(cases));
}

/// The number itself or, to compare, half and twice as much beside it.
inline std::vector<int> sizes_of(int middle, bool compared) {
    if (!compared) return {middle};
    return {middle / 2, middle, 2 * middle};
}

/// make(n) of each of sizes_of(), called by its number where there are several.
template <class Make>
auto by_size(int middle, bool compared, const Make& make) {
    std::vector<decltype(make(middle))> all;
    for (const int n : sizes_of(middle, compared)) {
        all.push_back(make(n));
        if (compared) all.back().call(std::to_string(n));
    }
    return all;
}

/// The last value of a column in each run.
inline std::vector<double> last_of(const std::vector<RunRecord>& runs, std::string_view column) {
    std::vector<double> values;
    for (const auto& run : runs) values.push_back(run.history.last(column));
    return values;
}

}  // namespace spam

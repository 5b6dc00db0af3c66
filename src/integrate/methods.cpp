// SPDX-License-Identifier: GPL-3.0-or-later
#include "arkode_tables.hpp"
#include "sprk.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/integrate/methods.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace spam {
namespace {

std::vector<IntegrationMethod> all_methods() {
    std::vector<IntegrationMethod> methods{{"rk4", 4, false, true},
                                           {"leapfrog", 2, false, true, true}};
    const auto add = [&](const std::vector<IntegrationMethod>& more) {
        methods.insert(methods.end(), more.begin(), more.end());
    };
    add(arkode_methods());
    add(sprk_methods());
    // GSL's rk2 goes on with the third-order solution of its pair.
    add({{"cvode:adams", 12, true, false, false, true},
         {"cvode:bdf", 5, true, false, false, true},
         {"gsl:rk2", 3, true, true},
         {"gsl:rk4", 4, true, true},
         {"gsl:rkf45", 5, true, true},
         {"gsl:rkck", 5, true, true},
         {"gsl:rk8pd", 8, true, true},
         {"gsl:msadams", 12, true, false, false, true}});
    return methods;
}

/// Names of a family without its prefix, "arkode:".
std::vector<std::string> names_of(std::string_view prefix) {
    std::vector<std::string> names;
    for (const auto& method : integration_methods())
        if (method.name.starts_with(prefix)) names.push_back(method.name.substr(prefix.size()));
    return names;
}

/// Why there is no such method.
std::string why_not(std::string_view name) {
    const std::size_t colon = name.find(':');
    const std::string prefix(name.substr(0, colon == name.npos ? 0 : colon + 1));
    const std::string word(name.substr(prefix.size()));
    const auto known = names_of(prefix);
    const auto listed = [&](const std::string& what) {
        return fmt::format("{} '{}'{} There are: {}{}", what, word, suggestion(word, known, prefix),
                           prefix, fmt::join(known, ", " + prefix));
    };
    if (prefix == "arkode:")
        return fmt::format("SUNDIALS has no explicit table '{}'{} The tables: {}", word,
                           suggestion(word, known, prefix), fmt::join(known, ", "));
    if (prefix == "sprk:" && known.empty())
        return fmt::format("'{}' needs SUNDIALS 6.6 or later, this is {}; use leapfrog", name,
                           sundials_version());
    if (prefix == "sprk:") return listed("SUNDIALS has no symplectic table");
    const bool implicit = word == "rk1imp" || word == "rk2imp" || word == "rk4imp" ||
                          word == "bsimp" || word == "msbdf";
    if (implicit && prefix == "gsl:")
        return fmt::format(
            "'{}' is implicit and needs the Jacobian of the rates, which models do not have; use "
            "cvode:bdf, or gsl:msadams or gsl:rk8pd where nothing decays fast",
            name);
    if (prefix == "gsl:") return listed("the GSL has no stepper");
    if (prefix == "cvode:") return listed("CVODE has no method");
    const auto all = names_of("");
    return fmt::format("'{}' is unknown{} There are: {}", name, suggestion(name, all),
                       fmt::join(all, ", "));
}

}  // namespace

const std::vector<IntegrationMethod>& integration_methods() {
    static const std::vector<IntegrationMethod> methods = all_methods();
    return methods;
}

const IntegrationMethod& integration_method(std::string_view name) {
    constexpr std::string_view long_prefix = "arkode:ARKODE_", prefix = "arkode:";
    std::string wanted(name);
    if (name.starts_with(long_prefix))
        wanted = std::string(prefix).append(name.substr(long_prefix.size()));
    for (const auto& method : integration_methods())
        if (method.name == wanted) return method;
    throw InputError("integrator: " + why_not(name));
}

}  // namespace spam

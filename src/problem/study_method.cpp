// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/problem/study_method.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace spam {
namespace {

/// SUNDIALS' names end in stages, order of the embedded solution, order; one number fewer means that
/// nothing is embedded.
StudyMethod of_table(const std::string& table) {
    const std::string name = "arkode:" + table.substr(std::string_view("ARKODE_").size());
    const bool embedded = table.find("KNOTH_WOLKE") == std::string::npos;
    return {name, table.back() - '0', embedded, true};
}

std::vector<StudyMethod> all_methods() {
    std::vector<StudyMethod> all{{"rk4", 4, false, true}};
    for (const auto& table : arkode_tables()) all.push_back(of_table(table));
    return all;
}

}  // namespace

std::string StudyMethod::title() const {
    std::string words, word;
    const auto finish = [&] {
        const bool numeral = std::all_of(word.begin(), word.end(),
                                         [](unsigned char c) { return std::isdigit(c) != 0; });
        const bool code = word.find_first_of("0123456789") != std::string::npos;
        if (!word.empty() && !numeral && word != "ERK") {
            for (std::size_t k = 1; !code && k < word.size(); ++k)
                word[k] = static_cast<char>(std::tolower(static_cast<unsigned char>(word[k])));
            words += (words.empty() ? "" : "-") + word;
        }
        word.clear();
    };
    if (!name.starts_with("arkode:")) return fmt::format("{} ({})", name, order);
    for (const char c : name.substr(name.find(':') + 1))
        if (c == '_')
            finish();
        else
            word += c;
    finish();
    return fmt::format("{} ({})", words, order);
}

std::string StudyMethod::word() const {
    std::string text = name.starts_with("arkode:") ? name.substr(name.find(':') + 1) : name;
    for (char& c : text)
        c = c == ':' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

IntegratorOptions StudyMethod::with_step(double dt) const {
    IntegratorOptions options;
    options.method = name;
    options.dt = dt;
    return options;
}

IntegratorOptions StudyMethod::with_tolerance(double tolerance) const {
    IntegratorOptions options;
    options.method = name;
    options.rtol = options.atol = tolerance;
    return options;
}

std::vector<std::string> available_methods(const std::vector<std::string>& names) {
    const auto all = all_methods();
    std::vector<std::string> known;
    for (const auto& name : names)
        if (std::any_of(all.begin(), all.end(), [&](const auto& m) { return m.name == name; }))
            known.push_back(name);
    return known;
}

std::vector<StudyMethod> study_methods(std::string_view list,
                                       const std::vector<std::string>& standard) {
    std::vector<std::string> wanted;
    for (std::size_t begin = 0; !list.empty() && begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const auto first = list.find_first_not_of(' ', begin);
        const auto last = list.find_last_not_of(' ', end - (end > begin ? 1 : 0));
        wanted.emplace_back(first < end ? list.substr(first, last - first + 1) : "");
        begin = end + 1;
    }
    if (wanted.empty()) wanted = standard;
    const auto all = all_methods();
    std::vector<std::string> names;
    for (const auto& method : all) names.push_back(method.name);
    std::vector<StudyMethod> chosen;
    for (const auto& name : wanted) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            throw InputError(fmt::format("methods: there is no '{}'{} Separate with commas: {}",
                                         name, suggestion(name, names), fmt::join(names, ",")));
        const auto& method = all[static_cast<std::size_t>(found - names.begin())];
        const auto same = [&](const StudyMethod& m) { return m.name == method.name; };
        if (std::any_of(chosen.begin(), chosen.end(), same))
            throw InputError(
                fmt::format("methods: '{}' is there twice; name every method once", name));
        chosen.push_back(method);
    }
    return chosen;
}

}  // namespace spam

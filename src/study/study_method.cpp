// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/study/study_method.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace spam {
namespace {

/// As integration_method() finds it, complaints under the name of the option that was given.
const IntegrationMethod& method_of_list(const std::string& name) {
    try {
        return integration_method(name);
    } catch (const InputError& error) {
        const std::string_view text = error.what(), prefix = "integrator";
        throw InputError("methods" +
                         std::string(text.substr(text.starts_with(prefix) ? prefix.size() : 0)));
    }
}

}  // namespace

std::string StudyMethod::title() const {
    std::string words, word;
    const auto finish = [&] {
        const bool numeral =
            std::ranges::all_of(word, [](unsigned char c) { return std::isdigit(c) != 0; });
        const bool code = word.find_first_of("0123456789") != std::string::npos;
        if (!word.empty() && !numeral && word != "ERK") {
            for (std::size_t k = 1; !code && k < word.size(); ++k)
                word[k] = static_cast<char>(std::tolower(static_cast<unsigned char>(word[k])));
            words += (words.empty() ? "" : "-") + word;
        }
        word.clear();
    };
    const std::string orders = (multistep ? "1-" : "") + std::to_string(order);
    if (!name.starts_with("arkode:")) {
        words = name;
        std::ranges::replace(words, ':', ' ');
        return fmt::format("{} ({})", words, orders);
    }
    for (const char c : name.substr(name.find(':') + 1))
        if (c == '_')
            finish();
        else
            word += c;
    finish();
    return fmt::format("{} ({})", words, orders);
}

std::string StudyMethod::word() const {
    std::string text = name.starts_with("arkode:") ? name.substr(name.find(':') + 1) : name;
    for (char& c : text)
        c = c == ':' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

IntegratorOptions StudyMethod::with_step(double dt) const { return {.method = name, .dt = dt}; }

IntegratorOptions StudyMethod::with_tolerance(double tolerance) const {
    return {.method = name, .dt = {}, .rtol = tolerance, .atol = tolerance};
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
    std::vector<StudyMethod> chosen;
    for (const auto& name : wanted) {
        const IntegrationMethod& method = method_of_list(name);
        for (const StudyMethod& other : chosen)
            if (other.name == method.name)
                throw InputError(
                    fmt::format("methods: '{}' is there twice; name every method once", name));
        chosen.push_back({method});
    }
    return chosen;
}

std::vector<std::string> methods_of_every_kind() {
    return {"rk4",
            "leapfrog",
            "arkode:BOGACKI_SHAMPINE_4_2_3",
            "arkode:CASH_KARP_6_4_5",
            "arkode:DORMAND_PRINCE_7_4_5",
            "arkode:VERNER_8_5_6",
            "arkode:FEHLBERG_13_7_8",
            "gsl:rk8pd",
            "cvode:adams"};
}

void add_system_option(Options& options, std::vector<std::string> names, std::string& chosen) {
    names.insert(names.begin(), "all");
    options.choice(
        "problem", names, "the system to study, or all of them",
        [&chosen, names](std::size_t k) { chosen = names[k]; },
        [&chosen, names] {
            return static_cast<std::size_t>(std::ranges::find(names, chosen) - names.begin());
        });
}

}  // namespace spam

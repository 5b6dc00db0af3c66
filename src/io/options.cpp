// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_entry.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

Allowed any_number() {
    return {[](double) { return true; }, "a finite number"};
}
Allowed positive() {
    return {[](double x) { return x > 0.0; }, "a number above 0"};
}
Allowed non_negative() {
    return {[](double x) { return x >= 0.0; }, "0 or above"};
}
Allowed at_least(double least) {
    return {[least](double x) { return x >= least; }, fmt::format("at least {:g}", least)};
}
Allowed between(double least, double most) {
    return {[=](double x) { return x >= least && x <= most; },
            fmt::format("between {:g} and {:g}", least, most)};
}

namespace {

template <class Number>
Number accepted(const std::string& name, const std::string& text, std::optional<Number> value,
                const Allowed& allowed, const std::string& unit) {
    const std::string words = allowed.words + (unit.empty() ? "" : " (in " + unit + ")");
    if (std::is_floating_point_v<Number> && !value)
        throw InputError(
            fmt::format("{}: '{}' is not a finite number; it must be {}", name, text, words));
    if (!value || !allowed.holds(*value))
        throw InputError(fmt::format("{}: '{}' must be {}", name, text, words));
    return *value;
}

/// "0.4 GPa" and "0.4GPa" are "0.4" where the unit is GPa.
std::string without_unit(std::string text, const std::string& unit) {
    if (unit.empty() || !text.ends_with(unit)) return text;
    text.resize(text.size() - unit.size());
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

}  // namespace

Options::Options(std::string program, std::string summary)
    : program_(std::move(program)),
      summary_(std::move(summary)),
      group_("Options") {}
Options::~Options() = default;
Options::Options(Options&&) noexcept = default;

void Options::group(std::string title) { group_ = std::move(title); }

Options::Entry& Options::add(std::string name, std::string help) {
    entries_.push_back(std::make_unique<Entry>());
    Entry& entry = *entries_.back();
    entry.name = std::move(name);
    entry.help = std::move(help);
    entry.group = group_;
    return entry;
}

/// What numbers have in common, whole or not, with a default or without.
template <class Target>
Options::Added Options::number(std::string name, Target& target, std::string help,
                               Allowed allowed) {
    constexpr bool whole =
        std::is_same_v<Target, int> || std::is_same_v<Target, std::optional<int>>;
    if (whole) allowed.words = "a whole number, " + allowed.words;
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = whole ? "INTEGER" : "NUMBER";
    entry.allowed = allowed.words;
    entry.set = [&entry, &target, allowed](const std::string& text) {
        const std::string number = without_unit(text, entry.unit);
        if constexpr (whole)
            target = accepted(entry.name, text, whole_number_in(number), allowed, entry.unit);
        else
            target = accepted(entry.name, text, number_in(number), allowed, entry.unit);
    };
    if constexpr (std::is_arithmetic_v<Target>) {
        entry.get = [&target] { return fmt::format("{}", target); };
    } else {
        entry.unset = [&target] { target.reset(); };
        entry.get = [&target] { return target ? fmt::format("{}", *target) : std::string{}; };
    }
    return {*this, entry.name};
}

template Options::Added Options::number(std::string, double&, std::string, Allowed);
template Options::Added Options::number(std::string, std::optional<double>&, std::string, Allowed);
template Options::Added Options::number(std::string, int&, std::string, Allowed);
template Options::Added Options::number(std::string, std::optional<int>&, std::string, Allowed);

Options::Added Options::text(std::string name, std::string& target, std::string help) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = "TEXT";
    entry.allowed = "a text in quotes";
    entry.is_text = true;
    entry.set = [&entry, &target](const std::string& text) {
        if (text.empty()) throw InputError(fmt::format("{}: must not be empty", entry.name));
        if (entry.in_case && !fits_toml(text))
            throw InputError(fmt::format(
                "{}: is not UTF-8, and case.toml could not hold it; give it another name",
                entry.name));
        target = text;
    };
    if (target.empty()) entry.unset = [&target] { target.clear(); };
    entry.get = [&target] { return target.empty() ? std::string{} : toml_string(target); };
    return {*this, entry.name};
}

Options::Added Options::flag(std::string name, bool& target, std::string help) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.is_flag = true;
    entry.allowed = "true or false";
    entry.set = [&entry, &target](const std::string& text) {
        if (text != "true" && text != "false")
            throw InputError(fmt::format("{}: '{}' must be true or false", entry.name, text));
        target = text == "true";
    };
    entry.unset = [&target, before = target] { target = before; };
    entry.get = [&target] { return std::string(target ? "true" : "false"); };
    return {*this, entry.name};
}

Options::Added Options::choice(std::string name, std::vector<std::string> names, std::string help,
                               std::function<void(std::size_t)> set,
                               std::function<std::size_t()> get) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = fmt::format("{}", fmt::join(names, "|"));
    entry.allowed = fmt::format("one of \"{}\"", fmt::join(names, "\", \""));
    entry.is_text = true;
    entry.set = [&entry, names, set = std::move(set)](const std::string& text) {
        const auto it = std::ranges::find(names, text);
        if (it == names.end())
            throw InputError(fmt::format("{}: '{}' is unknown{} Allowed: {}", entry.name, text,
                                         suggestion(text, names), fmt::join(names, ", ")));
        set(static_cast<std::size_t>(it - names.begin()));
    };
    entry.get = [names, get = std::move(get)] { return toml_string(names[get()]); };
    return {*this, entry.name};
}

void Options::unit(const std::vector<std::string>& names, const std::string& unit) {
    for (const auto& name : names) entry(name).unit = unit;
}

void Options::exclude_from_case(const std::vector<std::string>& names) {
    for (auto& entry : entries_)
        if (std::ranges::find(names, entry->name) != names.end()) entry->in_case = false;
}

std::vector<std::string> Options::names() const {
    std::vector<std::string> result;
    for (const auto& entry : entries_) result.push_back(entry->name);
    return result;
}

/// A flag that a file sets to false was left out on the command line that wrote it.
bool Options::has(std::string_view name) const {
    return std::ranges::any_of(entries_, [name](const auto& e) { return e->name == name; });
}

bool Options::given(std::string_view name) const {
    return std::ranges::any_of(entries_, [name](const auto& e) {
        return e->name == name && (e->in_file || e->on_command) &&
               !(e->is_flag && e->get() == "false");
    });
}

std::string Options::first_given(const std::vector<std::string>& names) const {
    for (const auto& name : names)
        if (given(name)) return name;
    return {};
}

}  // namespace spam

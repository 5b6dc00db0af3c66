// SPDX-License-Identifier: GPL-3.0-or-later
// Options that mean nothing in some cases: refused where given, else left out of the case.
#include "option_entry.hpp"
#include <spam/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace spam {

const Options::Added& Options::Added::only_when(std::vector<std::string> by,
                                                std::function<bool()> holds,
                                                std::string why) const {
    options_.only_when({name_}, std::move(by), std::move(holds), std::move(why));
    return *this;
}

const Options::Added& Options::Added::needs(const std::string& other) const {
    options_.need({name_}, other);
    return *this;
}

const Options::Added& Options::Added::excludes(std::vector<std::string> others) const {
    options_.exclude(name_, std::move(others));
    return *this;
}

const Options::Added& Options::Added::or_word(const std::string& word) const {
    Entry& entry = options_.entry(name_);
    entry.allowed = fmt::format("\"{}\", or {}", word, entry.allowed);
    entry.is_text = true;
    entry.word = word;
    entry.set = [&entry, word, number = entry.set](const std::string& text) {
        try {
            text == word ? entry.unset() : number(text);
        } catch (const InputError&) {
            throw InputError(fmt::format("{}: '{}' must be {}", entry.name, text, entry.allowed));
        }
    };
    entry.get = [word, number = entry.get] {
        const std::string value = number();
        return value.empty() ? toml_string(word) : value;
    };
    return *this;
}

const Options::Added& Options::Added::unit(const std::string& name) const {
    options_.unit({name_}, name);
    return *this;
}

Options::Entry& Options::entry(std::string_view name) const {
    const auto found =
        std::ranges::find_if(entries_, [name](const auto& e) { return e->name == name; });
    if (found == entries_.end())
        throw std::logic_error(fmt::format("there is no option '{}'", name));
    return **found;
}

void Options::only_when(std::vector<std::string> names, std::vector<std::string> by,
                        std::function<bool()> holds, std::string why) {
    rules_.push_back({std::move(names), std::move(by), std::move(holds), std::move(why)});
}

void Options::need(std::vector<std::string> names, const std::string& other) {
    only_when(
        std::move(names), {other}, [this, other] { return given(other); },
        fmt::format("has no meaning without --{}; add it, or leave this one out", other));
}

void Options::exclude(const std::string& name, std::vector<std::string> others, std::string why,
                      bool mutual) {
    if (why.empty()) why = "{by} settles it; leave one out";
    only_when(
        std::move(others), {name}, [this, name] { return !given(name); }, std::move(why));
    rules_.back().mutual = mutual;
}

void Options::one_of(const std::vector<std::string>& names, const std::string& what) {
    for (const auto& name : names) {
        std::vector<std::string> others = names;
        std::erase(others, name);
        exclude(name, others, fmt::format("--{} sets {} too; leave one out", name, what), true);
    }
    only_when({names.begin() + 1, names.end()}, {},
              [this, names] { return !first_given(names).empty(); }, {});
}

void Options::leave_out(const std::vector<std::string>& names) {
    for (const auto& one : entries_)
        if (std::ranges::find(names, one->name) != names.end()) one->has_meaning = false;
}

void Options::command_line_wins(const std::vector<std::string>& names,
                                const std::vector<std::string>& over) {
    if (std::ranges::none_of(names, [this](const auto& name) { return entry(name).on_command; }))
        return;
    for (const auto& name : over) {
        Entry& other = entry(name);
        if (other.on_command) continue;
        other.in_file = false;
        if (other.unset) other.unset();
    }
}

/// "{by}" in it stands for the option that decides, as it was given: "--figure 5".
std::string Options::reason(const Rule& rule) const {
    const auto at = rule.why.find("{by}");
    if (at == std::string::npos || rule.by.empty()) return rule.why;
    std::string given = first_given(rule.by);
    if (given.empty()) given = rule.by.front();
    const Entry& by = entry(given);
    std::string value = by.is_flag ? "" : " " + by.get();
    std::erase(value, '"');
    return fmt::format("{}--{}{}{}{}", rule.why.substr(0, at), given, value,
                       by.in_file && !by.on_command ? " of the file" : "", rule.why.substr(at + 4));
}

void Options::settle() {
    for (const auto& one : entries_) one->at_default = one->get() == one->default_value;
    for (const Rule& rule : rules_) {
        if (rule.mutual) command_line_wins(rule.names, rule.by);
        if (rule.holds()) continue;
        command_line_wins(rule.by, rule.names);
        if (const auto name = first_given(rule.names); !name.empty() && !rule.why.empty())
            throw InputError(fmt::format("{}: {}", name, reason(rule)));
        leave_out(rule.names);
    }
}

bool Options::at_default(const std::vector<std::string>& names) const {
    return std::ranges::all_of(names, [this](const auto& name) { return entry(name).at_default; });
}

}  // namespace spam

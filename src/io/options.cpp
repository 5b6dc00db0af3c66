// SPDX-License-Identifier: GPL-3.0-or-later
#include "options_entry.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

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

double parse_number(const std::string& name, const std::string& text, const Allowed& allowed) {
    double value = 0.0;
    const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc{} || end != last || !std::isfinite(value) || !allowed.holds(value))
        throw InputError(fmt::format("{}: '{}' must be {}", name, text, allowed.words));
    return value;
}

int parse_integer(const std::string& name, const std::string& text, const Allowed& allowed) {
    int value = 0;
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    if (error != std::errc{} || end != last || !allowed.holds(value))
        throw InputError(
            fmt::format("{}: '{}' must be a whole number, {}", name, text, allowed.words));
    return value;
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

void Options::number(std::string name, double& target, std::string help, Allowed allowed) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = "NUMBER";
    entry.allowed = allowed.words;
    entry.set = [&entry, &target, allowed](const std::string& text) {
        target = parse_number(entry.name, text, allowed);
    };
    entry.get = [&target] { return fmt::format("{}", target); };
}

void Options::number(std::string name, std::optional<double>& target, std::string help,
                     Allowed allowed) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = "NUMBER";
    entry.allowed = allowed.words;
    entry.set = [&entry, &target, allowed](const std::string& text) {
        target = parse_number(entry.name, text, allowed);
    };
    entry.unset = [&target] { target.reset(); };
    entry.get = [&target] { return target ? fmt::format("{}", *target) : std::string{}; };
}

void Options::integer(std::string name, int& target, std::string help, Allowed allowed) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = "INTEGER";
    entry.allowed = "a whole number, " + allowed.words;
    entry.set = [&entry, &target, allowed](const std::string& text) {
        target = parse_integer(entry.name, text, allowed);
    };
    entry.get = [&target] { return fmt::format("{}", target); };
}

void Options::integer(std::string name, std::optional<int>& target, std::string help,
                      Allowed allowed) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = "INTEGER";
    entry.allowed = "a whole number, " + allowed.words;
    entry.set = [&entry, &target, allowed](const std::string& text) {
        target = parse_integer(entry.name, text, allowed);
    };
    entry.unset = [&target] { target.reset(); };
    entry.get = [&target] { return target ? fmt::format("{}", *target) : std::string{}; };
}

void Options::text(std::string name, std::string& target, std::string help) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = "TEXT";
    entry.allowed = "a text in quotes";
    entry.is_text = true;
    entry.set = [&entry, &target](const std::string& text) {
        if (text.empty()) throw InputError(fmt::format("{}: must not be empty", entry.name));
        target = text;
    };
    if (target.empty()) entry.unset = [&target] { target.clear(); };
    entry.get = [&target] { return target.empty() ? std::string{} : toml_string(target); };
}

void Options::flag(std::string name, bool& target, std::string help) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.is_flag = true;
    entry.allowed = "true or false";
    entry.set = [&entry, &target](const std::string& text) {
        if (text != "true" && text != "false")
            throw InputError(fmt::format("{}: '{}' must be true or false", entry.name, text));
        target = text == "true";
    };
    entry.get = [&target] { return std::string(target ? "true" : "false"); };
}

void Options::choice(std::string name, std::vector<std::string> names, std::string help,
                     std::function<void(std::size_t)> set, std::function<std::size_t()> get) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = fmt::format("{}", fmt::join(names, "|"));
    entry.allowed = fmt::format("one of \"{}\"", fmt::join(names, "\", \""));
    entry.is_text = true;
    entry.set = [&entry, names, set = std::move(set)](const std::string& text) {
        const auto it = std::find(names.begin(), names.end(), text);
        if (it == names.end())
            throw InputError(fmt::format("{}: '{}' is unknown{} Allowed: {}", entry.name, text,
                                         suggestion(text, names), fmt::join(names, ", ")));
        set(static_cast<std::size_t>(it - names.begin()));
    };
    entry.get = [names, get = std::move(get)] { return toml_string(names[get()]); };
}

void Options::exclude_from_case(const std::vector<std::string>& names) {
    for (auto& entry : entries_)
        if (std::find(names.begin(), names.end(), entry->name) != names.end())
            entry->in_case = false;
}

std::vector<std::string> Options::names() const {
    std::vector<std::string> result;
    for (const auto& entry : entries_) result.push_back(entry->name);
    return result;
}

bool Options::parse(int argc, const char* const* argv) {
    CLI::App app(summary_, program_);
    app.allow_extras();
    app.set_help_flag("--help,-h", "print this help and exit");
    std::vector<std::string> raw(entries_.size());
    std::vector<CLI::Option*> registered;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        const Entry& entry = *entries_[k];
        CLI::Option* option = nullptr;
        if (entry.is_flag) {
            option = app.add_flag("--" + entry.name, entry.help);
        } else {
            std::string help = entry.help;
            const std::string standard = entry.get();
            if (!standard.empty()) help += fmt::format(" [{}]", standard);
            option = app.add_option("--" + entry.name, raw[k], help)->type_name(entry.type);
        }
        registered.push_back(option->group(entry.group));
    }
    const auto* config =
        app.add_option("--config", config_, "read options from a TOML file")->type_name("FILE");
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return false;
    } catch (const CLI::ParseError& error) {
        std::string message = error.what();
        std::replace(message.begin(), message.end(), '\n', ' ');
        throw InputError(message + "; see --help");
    }
    if (!app.remaining().empty()) {
        const std::string word = app.remaining().front();
        const std::string bare = word.substr(std::min(word.find_first_not_of('-'), word.size()));
        auto known = names();
        known.emplace_back("config");
        throw InputError(fmt::format("unknown option '{}'{} See --help", word,
                                     suggestion(bare.substr(0, bare.find('=')), known, "--")));
    }
    const auto refuse_option_as_value = [](const std::string& name, const std::string& value) {
        if (value.starts_with("--"))
            throw InputError(
                fmt::format("{}: '{}' is an option, not a value; the value of --{} is "
                            "missing",
                            name, value, name));
    };
    refuse_option_as_value("config", config_);
    if (config->count() > 0) read_config(config_);
    const bool earlier = read_earlier_case(raw, config->count() > 0);
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        if (registered[k]->count() == 0) continue;
        refuse_option_as_value(entries_[k]->name, raw[k]);
        const std::string before = entries_[k]->get();
        entries_[k]->set(entries_[k]->is_flag ? registered[k]->results().back() : raw[k]);
        if (earlier) refuse_change(*entries_[k], before);
        entries_[k]->on_command = true;
    }
    return true;
}

bool Options::given(std::string_view name) const {
    return std::any_of(entries_.begin(), entries_.end(), [name](const auto& e) {
        return e->name == name && (e->in_file || e->on_command);
    });
}

void Options::command_line_wins(const std::vector<std::string>& names,
                                const std::vector<std::string>& over) {
    const auto among = [](const auto& entry, const auto& list) {
        return std::find(list.begin(), list.end(), entry->name) != list.end();
    };
    if (std::none_of(entries_.begin(), entries_.end(),
                     [&](const auto& e) { return among(e, names) && e->on_command; }))
        return;
    for (auto& entry : entries_) {
        if (!among(entry, over) || entry->on_command) continue;
        entry->in_file = false;
        if (entry->unset) entry->unset();
    }
}

std::string Options::first_given(const std::vector<std::string>& names) const {
    for (const auto& name : names)
        if (given(name)) return name;
    return {};
}

}  // namespace spam

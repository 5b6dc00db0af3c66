// SPDX-License-Identifier: GPL-3.0-or-later
#include "option_entry.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
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

/// The whole of a file of options; throws InputError when there is nothing to read.
std::string text_of(const std::string& path) {
    if (path.empty()) throw InputError("config: must not be empty; give the name of a TOML file");
    std::error_code error;
    std::ifstream in(path, std::ios::binary);
    if (!in || std::filesystem::is_directory(path, error))
        throw InputError(fmt::format("config: '{}' is not a file that can be read", path));
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string toml_string(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            out += c;
    }
    return out + "\"";
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

void Options::text(std::string name, std::string& target, std::string help) {
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = "TEXT";
    entry.allowed = "a text in quotes";
    entry.is_text = true;
    entry.set = [&entry, &target](const std::string& text) {
        if (text.empty()) throw InputError(fmt::format("{}: must not be empty", entry.name));
        target = text;
    };
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

void Options::read_config(const std::string& path) {
    toml::table table;
    try {
        table = toml::parse(text_of(path), path);
    } catch (const toml::parse_error& error) {
        const auto& where = error.source().begin;
        throw InputError(fmt::format("config: {} line {}: {}", path, where.line,
                                     std::string(error.description())));
    }
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        const auto line = node.source().begin.line;
        const auto it = std::find_if(entries_.begin(), entries_.end(),
                                     [&](const auto& entry) { return entry->name == name; });
        if (it == entries_.end())
            throw InputError(fmt::format("config: {} line {}: unknown key '{}'{} See --help", path,
                                         line, name, suggestion(name, names())));
        Entry& entry = **it;
        std::string text;
        bool fits = false;
        if (const auto* s = node.as_string()) {
            text = s->get();
            fits = entry.is_text;
        } else if (const auto* i = node.as_integer()) {
            text = fmt::format("{}", i->get());
            fits = entry.type == "INTEGER" || entry.type == "NUMBER";
        } else if (const auto* f = node.as_floating_point()) {
            text = fmt::format("{}", f->get());
            fits = entry.type == "NUMBER";
        } else if (const auto* b = node.as_boolean()) {
            text = b->get() ? "true" : "false";
            fits = entry.is_flag;
        }
        if (!fits) {
            std::ostringstream value;  // as TOML writes it
            node.visit([&](const auto& v) { value << v; });
            if (node.is_string()) value.str(toml_string(text));
            throw InputError(fmt::format("config: {} line {}: {}: {} must be {}", path, line, name,
                                         value.str(), entry.allowed));
        }
        try {
            entry.set(text);
        } catch (const InputError& error) {
            throw InputError(fmt::format("config: {} line {}: {}", path, line, error.what()));
        }
        entry.in_file = true;
    }
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

std::vector<std::pair<std::string, std::string>> Options::resolved() const {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto& entry : entries_) {
        const std::string value = entry->get();
        if (entry->in_case && !value.empty()) result.emplace_back(entry->name, value);
    }
    return result;
}

std::string Options::case_toml(const std::vector<std::string>& without) const {
    std::string text = fmt::format(
        "# {}: the resolved case. Run it again with\n#   {} --config FILE\n", program_, program_);
    for (const auto& [name, value] : resolved())
        if (std::find(without.begin(), without.end(), name) == without.end())
            text += fmt::format("{} = {}\n", name, value);
    return text;
}

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/io/options.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <toml++/toml.h>

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

/// One option. Values travel as text: what the command line holds, and what a TOML value prints as.
struct Options::Entry {
    std::string name, help, group, type;
    std::string allowed;                          ///< completes "must be ..."
    std::function<void(const std::string&)> set;  ///< throws InputError
    std::function<std::string()> get;             ///< as a TOML value, empty when unset
    bool is_flag = false;
    bool is_text = false;  ///< TOML must give a string
    bool in_case = true;
    bool in_file = false;         ///< set by the file of --config
    bool on_command = false;      ///< set on the command line
    std::function<void()> unset;  ///< back to unset, where that exists
};

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
        throw InputError(fmt::format("{}: '{}' must be {}", name, text, allowed.words));
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

/// What numbers have in common, whole or not, with a default or without.
template <class Target>
void Options::number(std::string name, Target& target, std::string help, Allowed allowed) {
    constexpr bool whole =
        std::is_same_v<Target, int> || std::is_same_v<Target, std::optional<int>>;
    if (whole) allowed.words = "a whole number, " + allowed.words;
    Entry& entry = add(std::move(name), std::move(help));
    entry.type = whole ? "INTEGER" : "NUMBER";
    entry.allowed = allowed.words;
    entry.set = [&entry, &target, allowed](const std::string& text) {
        if constexpr (whole)
            target = parse_integer(entry.name, text, allowed);
        else
            target = parse_number(entry.name, text, allowed);
    };
    if constexpr (std::is_arithmetic_v<Target>) {
        entry.get = [&target] { return fmt::format("{}", target); };
    } else {
        entry.unset = [&target] { target.reset(); };
        entry.get = [&target] { return target ? fmt::format("{}", *target) : std::string{}; };
    }
}

template void Options::number(std::string, double&, std::string, Allowed);
template void Options::number(std::string, std::optional<double>&, std::string, Allowed);
template void Options::number(std::string, int&, std::string, Allowed);
template void Options::number(std::string, std::optional<int>&, std::string, Allowed);

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
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        if (registered[k]->count() == 0) continue;
        refuse_option_as_value(entries_[k]->name, raw[k]);
        entries_[k]->set(entries_[k]->is_flag ? registered[k]->results().back() : raw[k]);
        entries_[k]->on_command = true;
    }
    return true;
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

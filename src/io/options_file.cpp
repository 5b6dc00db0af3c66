// SPDX-License-Identifier: GPL-3.0-or-later
// Options from and to TOML: the file of --config, the case of an earlier run, case.toml.
#include "option_entry.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/io/text_file.hpp>

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace spam {
namespace {

std::string text_of(const std::string& path) {
    if (path.empty()) throw InputError("config: must not be empty; give the name of a TOML file");
    return text_file(path, "config", "a TOML file of options");
}

toml::table table_of(const std::string& text, const std::string& path) {
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        const auto& where = error.source().begin;
        throw InputError(fmt::format("config: {} line {}: {}", path, where.line,
                                     std::string(error.description())));
    }
}

/// What is wrong with a value that is no number, no text or neither true nor false where it should be.
/// `text`: the value, of a string.
template <class Entry>
std::string wrong_type(const std::string& name, const toml::node& node, const std::string& text,
                       const Entry& entry) {
    const toml::table* table = node.as_table();
    if (table != nullptr && !table->is_inline())
        return fmt::format("{0}: [{0}] begins a table, and options lie in none; write {0} = {1}",
                           name, entry.is_text ? "\"...\"" : "...");
    const bool number = entry.type == "INTEGER" || entry.type == "NUMBER";
    if (node.is_string() && (number || entry.is_flag))
        return fmt::format("{}: {} must be {}, without quotes ({})", name, toml_string(text),
                           number ? "a number" : "true or false", entry.allowed);
    std::ostringstream value;  // as TOML writes it
    node.visit([&](const auto& v) { value << v; });
    return fmt::format("{}: {} must be {}", name, value.str(), entry.allowed);
}

}  // namespace

std::string toml_string(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            out += c;
    }
    return out + "\"";
}

bool fits_toml(const std::string& text) {
    try {
        static_cast<void>(toml::parse("text = " + toml_string(text)));
        return true;
    } catch (const toml::parse_error&) {
        return false;
    }
}

void Options::case_from(std::string option, std::function<std::string(const std::string&)> read,
                        std::vector<std::string> may_change) {
    earlier_ = {std::move(option), std::move(read), std::move(may_change)};
}

/// Reads the case that an option brings, if it was given on the command line or in the file of --config.
/// `raw`: what the command line holds, by entry.
bool Options::read_earlier_case(const std::vector<std::string>& raw, bool has_config) {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        if (entries_[k]->name != earlier_.option || raw[k].empty()) continue;
        if (has_config)
            throw InputError(fmt::format("config: --{} brings a case of its own; leave one out",
                                         earlier_.option));
        read_case(earlier_.read(raw[k]), raw[k], false);
        return true;
    }
    if (!has_config) return false;
    const std::string text = text_of(config_);
    const auto table = table_of(text, config_);
    const toml::node* named = earlier_.option.empty() ? nullptr : table.get(earlier_.option);
    const auto* name = named == nullptr ? nullptr : named->as_string();
    if (name != nullptr && !name->get().empty()) try {
            read_case(earlier_.read(name->get()), name->get(), false);
        } catch (const InputError& error) {
            throw InputError(fmt::format("config: {} line {}: {}", config_,
                                         named->source().begin.line, error.what()));
        }
    read_case(text, config_, name != nullptr);
    return name != nullptr;
}

/// `before`: the value in the earlier case.
void Options::refuse_change(const Entry& entry, const std::string& before) const {
    const auto& free = earlier_.may_change;
    if (!entry.in_case || entry.get() == before ||
        std::find(free.begin(), free.end(), entry.name) != free.end())
        return;
    throw InputError(
        fmt::format("{}: {} differs from the earlier run's {}, and --{} goes on with the same "
                    "case; only {} may "
                    "change",
                    entry.name, entry.get(), before.empty() ? "(none)" : before, earlier_.option,
                    fmt::join(free, ", ")));
}

/// `beside_earlier`: what it says stands beside the case of an earlier run, as the command line does.
void Options::read_case(const std::string& text_of_case, const std::string& path,
                        bool beside_earlier) {
    const toml::table table = table_of(text_of_case, path);
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
        if (!fits)
            throw InputError(fmt::format("config: {} line {}: {}", path, line,
                                         wrong_type(name, node, text, entry)));
        try {
            const std::string before = entry.get();
            entry.set(text);
            if (beside_earlier) refuse_change(entry, before);
        } catch (const InputError& error) {
            throw InputError(fmt::format("config: {} line {}: {}", path, line, error.what()));
        }
        entry.in_file = true;
        entry.on_command = beside_earlier;
    }
}

std::string Options::case_toml(const std::map<std::string, std::string>& chosen) const {
    std::string text = fmt::format(
        "# {}: the resolved case. Run it again with\n#   {} --config FILE\n", program_, program_);
    for (const auto& entry : entries_) {
        if (!entry->has_meaning) continue;
        const auto choice = chosen.find(entry->name);
        std::string value = entry->in_case ? entry->get() : "";
        if (value.empty() && choice != chosen.end()) value = choice->second;
        if (value.empty()) continue;
        const std::string unit = entry->unit.empty() ? "" : "  # " + entry->unit;
        text += fmt::format("{} = {}{}\n", entry->name, value, unit);
    }
    return text;
}

}  // namespace spam

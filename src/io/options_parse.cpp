// SPDX-License-Identifier: GPL-3.0-or-later
// The command line: the only place that knows CLI11. What it complains of is said in our own words.
#include "option_entry.hpp"
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace spam {
namespace {

/// What the parser complains of where a value is missing: "--out: 1 required TEXT missing".
std::string without_value(const std::string& complaint) {
    const std::string name = complaint.substr(0, complaint.find_first_of(": ="));
    return fmt::format("{}: the value of {} is missing; see --help",
                       name.substr(std::min(name.find_first_not_of('-'), name.size())), name);
}

/// The parser takes "--quiet=", without the value announced, for "--quiet", and "--size= --speed" for
/// "--size --speed".
void refuse_missing_value(const std::string& name, bool is_flag, int argc,
                          const char* const* argv) {
    const std::string announced = "--" + name + "=";
    if (std::none_of(argv + std::min(1, argc), argv + argc,
                     [&](const char* word) { return word == announced; }))
        return;
    throw InputError(fmt::format("{0}: the value of --{0}= is missing; ", name) +
                     (is_flag ? fmt::format("write --{0}, --{0}=true or --{0}=false", name)
                              : fmt::format("write --{0} VALUE or --{0}=VALUE", name)));
}

/// A word of the command line that is nothing.
std::string stray_word(const std::string& word, std::vector<std::string> known) {
    if (!word.starts_with('-'))
        return fmt::format("'{}' belongs to no option; options are --name value. See --help", word);
    const std::string bare = word.substr(std::min(word.find_first_not_of('-'), word.size()));
    known.insert(known.end(), {"config", "help", "version"});
    return fmt::format("unknown option '{}'{} See --help", word,
                       suggestion(bare.substr(0, bare.find('=')), known, "--"));
}

}  // namespace

bool Options::parse(int argc, const char* const* argv) {
    CLI::App app(summary_, program_);
    app.allow_extras();
    app.set_help_flag("--help,-h", "print this help and exit");
    app.footer(footer_);
    app.set_version_flag("--version", version_, "print versions and exit");
    std::vector<std::string> raw(entries_.size());
    std::vector<CLI::Option*> registered;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        Entry& entry = *entries_[k];
        entry.default_value = entry.get();
        CLI::Option* option = nullptr;
        if (entry.is_flag) {
            // As a constant: a string that may be changed would be taken for the flag's target.
            option = app.add_flag("--" + entry.name, std::as_const(entry.help));
        } else {
            std::string help = entry.help + (entry.unit.empty() ? "" : ", " + entry.unit);
            if (!entry.default_value.empty()) help += fmt::format(" [{}]", entry.default_value);
            option =
                app.add_option("--" + entry.name, raw[k], help)
                    ->type_name(entry.word.empty() ? entry.type : entry.type + "|" + entry.word);
            option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
        }
        registered.push_back(option->group(entry.group));
    }
    const auto* config = app.add_option("--config", config_, "read options from a TOML file")
                             ->type_name("FILE")
                             ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    for (const auto& entry : entries_)
        refuse_missing_value(entry->name, entry->is_flag, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return false;
    } catch (const CLI::CallForVersion&) {
        std::fputs((version_ + "\n").c_str(), stdout);
        return false;
    } catch (const CLI::ParseError& error) {
        throw InputError(without_value(error.what()));
    }
    if (!app.remaining().empty()) throw InputError(stray_word(app.remaining().front(), names()));
    for (const CLI::Option* option : registered)
        if (option->get_expected_max() > 0 && option->count() > 1)
            throw InputError(fmt::format("{}: given {} times; leave all but one out",
                                         option->get_name().substr(2), option->count()));
    if (config->count() > 1)
        throw InputError(
            fmt::format("config: given {} times; leave all but one out; a file "
                        "cannot add to another",
                        config->count()));
    const auto refuse_option_as_value = [](const std::string& name, const std::string& value) {
        if (value.starts_with("--"))
            throw InputError(
                fmt::format("{}: '{}' is an option, not a value; the value of --{} is "
                            "missing",
                            name, value, name));
    };
    refuse_option_as_value("config", config_);
    const bool earlier = read_earlier_case(raw, config->count() > 0);
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        if (registered[k]->count() == 0) continue;
        refuse_option_as_value(entries_[k]->name, raw[k]);
        const std::string before = entries_[k]->get();
        if (entries_[k]->is_flag)
            for (const auto& value : registered[k]->results()) entries_[k]->set(value);
        else
            entries_[k]->set(raw[k]);
        if (earlier) refuse_change(*entries_[k], before);
        entries_[k]->on_command = true;
    }
    return true;
}

}  // namespace spam

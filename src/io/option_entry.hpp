// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/io/options.hpp>

namespace spam {

/// One option. Values travel as text: what the command line holds, and what a TOML value prints as.
struct Options::Entry {
    std::string name, help, group, type;
    std::string allowed;                          ///< completes "must be ..."
    std::function<void(const std::string&)> set;  ///< throws InputError
    std::function<std::string()> get;             ///< as a TOML value, empty when unset
    bool is_flag = false;
    bool is_text = false;  ///< TOML must give a string
    bool in_case = true;
    bool has_meaning = true;  ///< in this case
    bool at_default = true;   ///< as settle() found it
    std::string unit;  ///< of its number, which may stand behind it; empty where there is none
    std::string word;  ///< that stands for no number; empty where none does
    std::string default_value;    ///< what get() said before anything was parsed
    bool in_file = false;         ///< set by the file of --config
    bool on_command = false;      ///< set on the command line
    std::function<void()> unset;  ///< back to unset, where that exists
};

/// As a TOML value.
std::string toml_string(const std::string& text);
/// Whether TOML can hold it: it is UTF-8.
bool fits_toml(const std::string& text);

}  // namespace spam

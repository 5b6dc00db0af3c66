// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spam {

/// Which numbers an option accepts. `words` completes "must be ...".
struct Allowed {
    /// Whether a number is accepted.
    std::function<bool(double)> holds;
    /// What is accepted, in words.
    std::string words;
};
Allowed any_number();
Allowed positive();
Allowed non_negative();
Allowed at_least(double least);
Allowed between(double least, double most);

/// The options of a problem: typed, with defaults and help, from the command line (--name value)
/// and from a TOML file (name = value; the command line wins). A wrong name, type or value throws
/// InputError: one line with the option, the value, what is allowed and a hint.
class Options {
  public:
    /// Of a program; `summary` is the first line of --help.
    Options(std::string program, std::string summary);
    ~Options();
    Options(Options&&) noexcept;

    /// What --version prints.
    void version(std::string text) { version_ = std::move(text); }
    /// What --help ends with.
    void footer(std::string text) { footer_ = std::move(text); }
    /// Heading under which the options added next appear in --help.
    void group(std::string title);

    /// An option just added, for the rules that it comes with (below).
    class Added {
      public:
        /// Made by number(), text(), flag() and choice().
        Added(Options& options, std::string name) : options_(options), name_(std::move(name)) {}
        /// Options::only_when of this option.
        const Added& only_when(std::vector<std::string> by, std::function<bool()> holds,
                               std::string why) const;
        /// Options::need of this option.
        const Added& needs(const std::string& other) const;
        /// Options::exclude of this option.
        const Added& excludes(std::vector<std::string> others) const;
        /// `word` stands for no number, which is the default of an optional one.
        const Added& or_word(const std::string& word) const;
        /// Options::unit of this option.
        const Added& unit(const std::string& name) const;

      private:
        Options& options_;
        std::string name_;
    };

    // Here and below `target` holds the default and receives the value; it must outlive parse().
    /// A double or an int, or an optional one without default, which must hold what `allowed` says. Here and below:
    /// `help` is its line in --help.
    template <class Target>
    Added number(std::string name, Target& target, std::string help, Allowed allowed);
    /// A whole number.
    template <class Target>
    Added integer(std::string name, Target& target, std::string help, Allowed allowed) {
        return number(std::move(name), target, std::move(help), std::move(allowed));
    }
    /// Any words.
    Added text(std::string name, std::string& target, std::string help);
    /// On when given without a value; in a file true or false.
    Added flag(std::string name, bool& target, std::string help);
    /// One of `names`: `set` receives its place, `get` tells the default's.
    Added choice(std::string name, std::vector<std::string> names, std::string help,
                 std::function<void(std::size_t)> set, std::function<std::size_t()> get);

    /// One of an enumeration whose values are named by to_string(Enum).
    template <class Enum>
    Added choice(std::string name, Enum& target, std::vector<Enum> values, std::string help) {
        std::vector<std::string> names;
        for (const Enum v : values) names.emplace_back(to_string(v));
        return choice(
            std::move(name), std::move(names), std::move(help),
            [&target, values](std::size_t k) { target = values[k]; },
            [&target, values] {
                std::size_t k = 0;
                while (values[k] != target) ++k;
                return k;
            });
    }

    /// Unit of the numbers of these options, as said in --help, case.toml and messages. On the command line it may
    /// stand behind the number, with or without a space: no other unit is understood.
    void unit(const std::vector<std::string>& names, const std::string& unit);

    /// Options that say how to run rather than what to compute (--out, --quiet, ...): not part of
    /// the case that is written back. Applies to options already added.
    void exclude_from_case(const std::vector<std::string>& names);

    /// `option`, a text already added, brings the case of an earlier run: `read` makes its TOML from the
    /// option's value. On the command line, or in the file of --config that names it, only `may_change`
    /// may then differ from it, and options that are no part of a case.
    void case_from(std::string option, std::function<std::string(const std::string&)> read,
                   std::vector<std::string> may_change);

    /// Reads the command line and, if --config was given, its file. Returns false when help or
    /// the version was asked for (and printed).
    bool parse(int argc, const char* const* argv);

    // Rules of options that mean nothing in some cases. settle() applies them in their order: what has no
    // meaning is refused where it was given ("<option>: <why>"), and else is no part of the case. Where
    // one of the options that decide, `by`, was given on the command line, what a file says of the others
    // no longer counts: a case read back can be changed without editing it.

    /// `names` have a meaning only where `holds`. An empty `why`: they are never refused. "{by}" in it
    /// stands for the option that decides and its value.
    void only_when(std::vector<std::string> names, std::vector<std::string> by,
                   std::function<bool()> holds, std::string why);
    /// `names` have a meaning only beside `other`.
    void need(std::vector<std::string> names, const std::string& other);
    /// Where `name` was given, it settles what `others` would. `mutual`: on the command line either wins
    /// over a file that holds the other.
    void exclude(const std::string& name, std::vector<std::string> others, std::string why = {},
                 bool mutual = false);
    /// No more than one of them may be given: each sets `what`. The first one holds where none is.
    void one_of(const std::vector<std::string>& names, const std::string& what);
    /// For what is only known later: these, where there are such options, are no part of the case.
    void leave_out(const std::vector<std::string>& names);

    /// Where one of `names` was given on the command line, `over` from the file no longer count.
    void command_line_wins(const std::vector<std::string>& names,
                           const std::vector<std::string>& over);

    /// Applies the rules, once all is parsed.
    void settle();

    /// Whether every one of `names` has the value that it has when nothing is given. After settle().
    bool at_default(const std::vector<std::string>& names) const;

    /// Whether there is an option of this name.
    bool has(std::string_view name) const;
    /// Whether the user set the option (command line or file).
    bool given(std::string_view name) const;
    /// The first of `names` that the user set; empty if none.
    std::string first_given(const std::vector<std::string>& names) const;

    /// The resolved case as TOML. `chosen`: values, as TOML, that the program has chosen for options that
    /// were left open.
    std::string case_toml(const std::map<std::string, std::string>& chosen = {}) const;

  private:
    struct Entry;
    Entry& add(std::string name, std::string help);
    void read_case(const std::string& text_of_case, const std::string& path, bool beside_earlier);
    bool read_earlier_case(const std::vector<std::string>& raw, bool has_config);
    void refuse_change(const Entry& entry, const std::string& before) const;
    std::vector<std::string> names() const;
    Entry& entry(std::string_view name) const;

    struct Rule {
        std::vector<std::string> names, by;
        std::function<bool()> holds;
        std::string why;
        bool mutual = false;  ///< the command line's of either side wins over a file's of the other
    };

    std::string reason(const Rule& rule) const;

    std::string program_, summary_, version_, footer_, group_;
    std::string config_;
    struct {
        std::string option;
        std::function<std::string(const std::string&)> read;
        std::vector<std::string> may_change;
    } earlier_;
    std::vector<std::unique_ptr<Entry>> entries_;
    std::vector<Rule> rules_;
};

}  // namespace spam

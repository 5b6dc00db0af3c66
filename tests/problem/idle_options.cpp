// SPDX-License-Identifier: GPL-3.0-or-later
// No option may silently do nothing: every option of every problem, given another legal value, is
// refused, or changes the results and is part of case.toml. Words in a banner are no results.
//
// These are thousands of runs, which is why cases are small, and why options of the session are tried once for
// every kind of results that a program leaves, not in every case (`of_the_session`). What a program was tried with in
// one case is tried in every 288th of the others, and in all of them in long runs.
#include "problem/idle_options.hpp"

#include "problem/result_files.hpp"
#include "support/effort.hpp"
#include <spam/io/checkpoint_file.hpp>
#include <spam/problem/problem.hpp>

#include <boost/test/unit_test.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

using namespace spam::test;

namespace {

struct Option {
    std::string name;
    bool has_value;  ///< in --help a word in capitals, or words to choose from, follows
};

std::vector<Option> options_of(const std::string& program) {
    std::vector<Option> options;
    for (const auto& line : split(run(problem(program, {"--help"})).out, '\n')) {
        const auto at = line.find_first_not_of(' ');
        if (at == std::string::npos || at > 8 || line.compare(at, 2, "--") != 0) continue;
        const auto end = line.find_first_of(" ,", at);
        const bool value = end != std::string::npos && end + 1 < line.size() && line[end] == ' ' &&
                           line[end + 1] != ' ';
        options.push_back({line.substr(at + 2, end - at - 2), value});
    }
    return options;
}

struct Ran {
    Outcome outcome;
    std::string case_toml;
    std::map<std::string, std::string> results;
};

/// Tables of studies end with the seconds of a run.
std::string without_seconds(const std::string& table) {
    const auto header = table.find(",seconds\n");
    if (header == std::string::npos || header > table.find('\n')) return table;
    std::string text;
    for (const auto& line : split(table, '\n')) text += line.substr(0, line.rfind(',')) + '\n';
    return text;
}

/// Of the cases in a checkpoint.
std::string times_in(const std::filesystem::path& file) {
    const spam::CheckpointReader checkpoint(file);
    std::string times;
    for (int k = 0; checkpoint.has("/cases/" + std::to_string(k) + "/t"); ++k)
        times +=
            std::to_string(checkpoint.numbers("/cases/" + std::to_string(k) + "/t").at(0)) + " ";
    return times;
}

Ran run_with(const std::string& program, const Words& arguments) {
    const Scratch folder;
    Words words{"--smoke", "--no-plots", "--out", "out"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    Ran ran;
    ran.outcome = Child(problem(program, words), {folder.path()}).finish(Child::Seconds(300));
    if (!std::filesystem::exists(folder / "out/case.toml")) return ran;
    ran.case_toml = contents_of(folder / "out/case.toml");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "out")) {
        const auto name = entry.path().filename();
        if (name.extension() == ".h5") ran.results[name] = times_in(entry.path());
        const bool table = name.extension() == ".csv" && name != "references.csv";
        if (table || name == "result.json" || name == "snapshots.pvd")
            ran.results[entry.path().lexically_relative(folder / "out")] =
                without_seconds(contents_of(entry.path()));
    }
    return ran;
}

/// Which code of a session a case goes through: that of one run, of several or of none, by which integrator.
std::string kind_of(const Words& words, const Ran& ran) {
    std::string kind = "none";
    for (const auto& [file, contents] : ran.results)
        if (file.ends_with("invariants.csv")) kind = file == "invariants.csv" ? "one" : "several";
    const auto integrator = std::find(words.begin(), words.end(), "--integrator");
    return integrator == words.end() ? kind : kind + " by " + integrator[1];
}

/// The words of a case with others in place of those of the same options, or after them.
Words with(Words words, const Words& others) {
    for (std::size_t k = 0; k < others.size(); ++k) {
        const bool has_value = k + 1 < others.size() && !others[k + 1].starts_with("--");
        const auto given = std::find(words.begin(), words.end(), others[k]);
        if (given == words.end())
            words.insert(words.end(), &others[k], &others[k] + (has_value ? 2 : 1));
        else if (has_value)
            given[1] = others[k + 1];
        if (has_value) ++k;
    }
    return words;
}

/// What one program is tried with.
class Trial {
  public:
    Trial(std::string program, std::size_t number) : program_(std::move(program)), number_(number) {
        for (const auto& option : options_of(program_))
            if (!no_part_of_the_case.contains(option.name) &&
                !cannot_show.contains({program_, option.name}))
                options_.push_back(option);
    }
    void every_option_of(const Words& words);
    /// An option that all cases give is given with two values in them.
    void nothing_is_left_out() const {
        for (const auto& option : options_)
            BOOST_TEST((tried_.contains(option.name) || left_to_others(option.name)),
                       program_ << " --" << option.name);
    }
    std::size_t tried() const { return tried_.size(); }

  private:
    void check(const Words& words, const Option& option, bool has_run);
    /// An option of the session is tried in every 32nd program, one of the scheme in every twelfth, and all of them
    /// everywhere in long runs.
    bool left_to_others(const std::string& option) const {
        const auto left = [&](const auto& shared, std::size_t programs) {
            const auto at = std::find(shared.begin(), shared.end(), option);
            const auto place = static_cast<std::size_t>(std::distance(shared.begin(), at));
            return at != shared.end() && (number_ + place) % programs != 0;
        };
        return !long_runs() &&
               (left(of_the_session, 32) || left(spam::Problem::scheme_option_names(), 12));
    }
    /// The run to compare with.
    const Ran& ran_with(const Words& words) {
        const auto known = ran_.find(words);
        return known != ran_.end() ? known->second
                                   : ran_.emplace(words, run_with(program_, words)).first->second;
    }

    std::string program_;
    std::size_t number_;
    std::vector<Option> options_;
    std::map<Words, Ran> ran_;
    std::set<std::string> tried_;  ///< options
    std::size_t again_ = 0;        ///< times that one of them came again
    std::set<std::pair<std::string, std::string>>
        common_;  ///< kinds of cases and options of the session
};

/// The value to try; of an option that takes one there is one.
std::string value_of(const std::string& program, const std::string& option) {
    const auto own = own_value.find({program, option});
    if (own != own_value.end()) return own->second;
    const auto another = another_value.find(option);
    BOOST_REQUIRE_MESSAGE(another != another_value.end(),
                          program << " --" << option << ": no value to try");
    return another->second;
}

/// Words that must be there with it.
Words needed_by(const std::string& program, const std::string& option) {
    const auto own = own_beside.find({program, option});
    if (own != own_beside.end()) return own->second;
    return beside.contains(option) ? beside.at(option) : Words{};
}

/// Whether the value was refused, whatever else is given, so that nothing was tried.
bool about_the_value(const std::string& refusal) {
    for (const char* words : {" must be ", "is unknown", "is missing", "finite number"})
        if (refusal.find(words) != std::string::npos) return true;
    return false;
}

void Trial::check(const Words& words, const Option& one, bool has_run) {
    const std::string& option = one.name;
    Words base = with(words, needed_by(program_, option));
    // They take half the time of short runs. What only compares has none.
    if (has_run && option != "checkpoint-every" && option != "compare")
        base = with(base, {"--checkpoint-every", "1e6"});
    Words changed{"--" + option};
    if (one.has_value) changed.push_back(value_of(program_, option));
    changed = with(base, changed);
    const bool given = std::find(words.begin(), words.end(), "--" + option) != words.end();
    if (changed == base || (given && tried_.contains(option))) return;
    tried_.insert(option);
    const Ran ran = run_with(program_, changed);
    std::string shown = program_;
    for (const auto& word : changed) shown.append(" ").append(word);
    BOOST_TEST_CONTEXT(shown) {
        if (ran.outcome.status == 2) {
            BOOST_TEST(ran.outcome.err.find(option) != std::string::npos, ran.outcome.err);
            BOOST_TEST(!about_the_value(ran.outcome.err), ran.outcome.err);
            return;
        }
        BOOST_TEST(ran.case_toml.find("\n" + option + " = ") != std::string::npos);
        BOOST_TEST((ran.results != ran_with(base).results), "it does nothing");
    }
}

/// Of this process' children, ended ones.
double processor_seconds() {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

void Trial::every_option_of(const Words& words) {
    const double start = processor_seconds();
    const Ran& before = ran_with(words);
    BOOST_REQUIRE_MESSAGE(before.outcome.status == 0, program_ << before.outcome.err);
    const std::string kind = kind_of(words, before);
    for (const auto& option : options_) {
        if (left_to_others(option.name) ||
            (of_the_session.contains(option.name) && !common_.insert({kind, option.name}).second))
            continue;
        if (!long_runs() && tried_.contains(option.name) && ++again_ % 288 != 0) continue;
        check(words, option, !kind.starts_with("none"));
    }
    std::string shown = program_;
    for (const auto& word : words) shown.append(" ").append(word);
    BOOST_TEST_MESSAGE(shown << ": " << processor_seconds() - start << " s");
}

/// Their names, in the order of `cases`.
std::vector<std::string> programs() {
    std::vector<std::string> names;
    for (const auto& [program, words] : cases)
        if (std::find(names.begin(), names.end(), program) == names.end()) names.push_back(program);
    return names;
}

/// ctest runs every fifth program apart, so that they share the processors.
bool is_mine(std::size_t number) {
    const char* part = std::getenv("SPAM_FIFTH");
    return part == nullptr || number % 5 == std::strtoul(part, nullptr, 10);
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_option_has_an_effect_or_is_refused) {
    std::size_t tried = 0;
    const auto names = programs();
    for (std::size_t number = 0; number < names.size(); ++number) {
        if (!is_mine(number)) continue;
#if SPAM_SANITIZED
        if (names[number] != "rotating_hexagon") continue;  // thousands of runs, ten times slower
#endif
        Trial trial(names[number], number);
        for (const auto& [program, words] : cases)
            if (program == names[number]) trial.every_option_of(words);
        trial.nothing_is_left_out();
        tried += trial.tried();
    }
    BOOST_TEST((SPAM_SANITIZED || tried > 100u));
}

BOOST_AUTO_TEST_CASE(every_problem_has_a_case) {
    std::set<std::string> problems;
    for (const auto& [program, base] : cases) problems.insert(program);
    for (const auto& program : split(SPAM_PROBLEM_NAMES, ','))
        BOOST_TEST(problems.contains(program), program << " has no case here");
}

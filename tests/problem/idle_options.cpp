// SPDX-License-Identifier: GPL-3.0-or-later
// No option may silently do nothing: every option of every problem, given another legal value, is
// refused, or changes the results and is part of case.toml. Words in a banner are no results.
#include "problem/idle_options.hpp"

#include "problem/result_files.hpp"
#include <spam/io/checkpoint_file.hpp>

#include <boost/test/unit_test.hpp>

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

/// Runs to compare with, by their words.
class Comparisons {
  public:
    explicit Comparisons(std::string program) : program_(std::move(program)) {}
    const Ran& with(const Words& words) {
        const auto known = ran_.find(words);
        return known != ran_.end() ? known->second
                                   : ran_.emplace(words, run_with(program_, words)).first->second;
    }

  private:
    std::string program_;
    std::map<Words, Ran> ran_;
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

/// Whether the value was refused, whatever else is given, so that nothing was tried.
bool about_the_value(const std::string& refusal) {
    for (const char* words : {" must be ", "is unknown", "is missing", "finite number"})
        if (refusal.find(words) != std::string::npos) return true;
    return false;
}

void check_option(const std::string& program, Words words, Comparisons& comparisons,
                  const Option& one) {
    const std::string& option = one.name;
    if (beside.contains(option))
        words.insert(words.end(), beside.at(option).begin(), beside.at(option).end());
    const Words base = words;
    words.push_back("--" + option);
    if (one.has_value) words.push_back(value_of(program, option));
    const Ran ran = run_with(program, words);
    std::string shown = program;
    for (const auto& word : words) shown.append(" ").append(word);
    BOOST_TEST_CONTEXT(shown) {
        if (ran.outcome.status == 2) {
            BOOST_TEST(ran.outcome.err.find(option) != std::string::npos, ran.outcome.err);
            BOOST_TEST(!about_the_value(ran.outcome.err), ran.outcome.err);
            return;
        }
        BOOST_TEST(ran.case_toml.find("\n" + option + " = ") != std::string::npos);
        BOOST_TEST((ran.results != comparisons.with(base).results), "it does nothing");
    }
}

/// ctest runs every fifth case apart, so that they share the processors.
bool is_mine(std::size_t number) {
    const char* part = std::getenv("SPAM_FIFTH");
    return part == nullptr || number % 5 == std::strtoul(part, nullptr, 10);
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_option_has_an_effect_or_is_refused) {
    std::size_t tried = 0;
    for (std::size_t number = 0; number < cases.size(); ++number) {
        const auto& [program, base] = cases[number];
        if (!is_mine(number)) continue;
#if SPAM_SANITIZED
        if (program != "rotating_hexagon") continue;  // thousands of runs, ten times slower
#endif
        Comparisons comparisons(program);
        const Ran& before = comparisons.with(base);
        BOOST_REQUIRE_MESSAGE(before.outcome.status == 0, program << before.outcome.err);
        for (const auto& option : options_of(program)) {
            const bool given =
                std::find(base.begin(), base.end(), "--" + option.name) != base.end();
            if (given || no_part_of_the_case.contains(option.name)) continue;
            check_option(program, base, comparisons, option);
            ++tried;
        }
    }
#if !SPAM_SANITIZED
    BOOST_TEST(tried > 100u);
#endif
}

BOOST_AUTO_TEST_CASE(every_problem_has_a_case) {
    std::set<std::string> problems;
    for (const auto& [program, base] : cases) problems.insert(program);
    for (const auto& program : split(SPAM_PROBLEM_NAMES, ','))
        BOOST_TEST(problems.contains(program), program << " has no case here");
}

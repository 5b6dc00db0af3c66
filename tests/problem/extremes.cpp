// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers at the ends of what options allow, and beyond. Beyond, the option is refused by name; at the ends a run
// is one like others, or is refused or stopped with the reason: no check, and no promise, fails for them.
#include "problem/result_files.hpp"
#include "support/hunt.hpp"

#include <boost/test/unit_test.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <set>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

const Words& programs() {
    static const Words all = split(SPAM_PROBLEM_NAMES, ',');
    return all;
}

struct NumberOption {
    std::string name;
    std::string line;  ///< of --help: the same in two programs where the same code adds it
};

struct Help {
    std::vector<NumberOption> numbers;
    bool has_kernel = false;
};

/// What --help of a program says, asked for once.
const Help& help_of(const std::string& program) {
    static const std::regex number(R"(^ {2,8}--([a-z0-9-]+) (NUMBER|INTEGER)\b)");
    static std::map<std::string, Help> known;
    const auto [at, is_new] = known.try_emplace(program);
    if (!is_new) return at->second;
    for (const auto& line : split(run(problem(program, {"--help"})).out, '\n')) {
        std::smatch found;
        if (std::regex_search(line, found, number)) at->second.numbers.push_back({found[1], line});
        if (line.starts_with("  --kernel ")) at->second.has_kernel = true;
    }
    return at->second;
}

/// Seeds that follow each other go evenly through all; those of a hunt, which are random, take any.
template <class All>
const auto& one_of(const All& all, unsigned seed) {
    const double place = std::fmod(std::numbers::phi * seed, 1.0);
    return all[static_cast<std::size_t>(place * static_cast<double>(all.size()))];
}

struct Call {
    std::string program;
    Words words;
    std::string shown() const {
        std::string text = program;
        for (const auto& word : words) text += " " + word;
        return text;
    }
    /// Ended by SIGXCPU where it takes more seconds of a processor.
    Outcome outcome(const Scratch& folder, rlim_t seconds) const {
        Launch launch{folder.path()};
        launch.before_exec = [seconds] {
            const rlimit limit{seconds, seconds};
            setrlimit(RLIMIT_CPU, &limit);
        };
        return Child(problem(program, words), launch)
            .finish(Child::Seconds(SPAM_SANITIZED ? 1000 : 240));
    }
};

/// Status 0, 2 or 3; one line where it is not 0.
void check_honest(const Call& call, rlim_t seconds) {
    BOOST_TEST_CONTEXT(call.shown()) {
        const Scratch folder;
        const Outcome outcome = call.outcome(folder, seconds);
        if (outcome.signal == SIGXCPU || outcome.signal == SIGKILL)
            return;  // longer than this test
        BOOST_TEST((outcome.status == 0 || outcome.status == 2 || outcome.status == 3),
                   "status " << outcome.status << ", signal " << outcome.signal << "\n"
                             << outcome.out << outcome.err);
        if (outcome.status == 2) BOOST_TEST(folder.listing().empty());
        if (outcome.status == 2 || outcome.status == 3)
            BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1, outcome.err);
    }
}

Words smoke(const std::string& option, const std::string& value) {
    return {"--smoke", "--no-plots", "--quiet", "--out", "out", "--" + option + "=" + value};
}

/// "between A and B" of what refuses 1e300: both ends, empty where there are none.
Words ends_of(const std::string& program, const std::string& option) {
    static const std::regex range(R"(between ([-+.0-9e]+) and ([-+.0-9e]+))");
    const Scratch folder;
    const Outcome outcome = run(problem(program, smoke(option, "1e300")), {folder.path()});
    std::smatch found;
    if (outcome.status != 2 || !outcome.err.starts_with(program + ": " + option + ":") ||
        !std::regex_search(outcome.err, found, range))
        return {};
    return {found[1], found[2]};
}

/// One of the ends of an option's range, empty where it has none or the end is a large whole number, which says how
/// many there are of something.
std::string end_of(const std::string& program, const std::string& option, std::mt19937& random) {
    const bool whole =
        option == "threads" || option == "ranks" || option == "jobs" || option == "max-steps";
    Words ends = whole ? Words{} : ends_of(program, option);
    if (ends.empty()) return {};
    if (ends[1].find('e') == std::string::npos && ends[1].size() >= 4) ends.pop_back();
    return ends[random() % ends.size()];
}

}  // namespace

/// What the same code adds to many programs is tried in one of them.
BOOST_AUTO_TEST_CASE(numbers_beyond_all_reason_are_refused_by_name) {
    std::set<std::string> tried;
    for (const auto& program : programs())
        for (const auto& [option, line] : help_of(program).numbers) {
            if (!tried.insert(line).second) continue;
            const Call call{program, smoke(option, "-1e300")};
            BOOST_TEST_CONTEXT(call.shown()) {
                const Scratch folder;
                const Outcome outcome = call.outcome(folder, 100);
                BOOST_TEST(outcome.status == 2, outcome.out);
                BOOST_TEST(outcome.err.starts_with(program + ": " + option + ":"), outcome.err);
                BOOST_TEST(folder.listing().empty());
            }
        }
    BOOST_TEST_MESSAGE(tried.size() << " options");
    BOOST_TEST(tried.size() > 200U);
}

BOOST_AUTO_TEST_CASE(runs_with_huge_and_tiny_numbers_end_honestly) {
    hunt(8, [](unsigned seed) {
        std::mt19937 random(seed);
        const auto& program = one_of(programs(), seed);
        const auto& numbers = help_of(program).numbers;
        const auto& option = numbers[random() % numbers.size()].name;
        check_honest({program, smoke(option, random() % 2 == 0 ? "1e300" : "1e-300")},
                     hunting() ? 60 : 1);
    });
}

BOOST_AUTO_TEST_CASE(runs_at_the_ends_of_ranges_end_honestly) {
    hunt(12, [](unsigned seed) {
        std::mt19937 random(seed);
        const auto& program = one_of(programs(), seed);
        const auto& numbers = help_of(program).numbers;
        std::string option, end;
        while (end.empty()) {
            option = numbers[random() % numbers.size()].name;
            end = end_of(program, option, random);
        }
        check_honest({program, smoke(option, end)}, hunting() ? 60 : 1);
    });
}

/// The default step is one for the weight function chosen.
BOOST_AUTO_TEST_CASE(every_weight_function_keeps_what_is_promised) {
    const auto check = [](const std::string& program, const std::string& kernel, rlim_t seconds) {
        check_honest({program, smoke("kernel", kernel)}, hunting() ? 60 : seconds);
    };
    for (const char* program : {"sheared_square", "lattice_stability", "string_phase"})
        check(program, "w8", 20);
    static const Words with_kernel = [] {
        Words all;
        for (const auto& program : programs())
            if (help_of(program).has_kernel) all.push_back(program);
        return all;
    }();
    hunt(8, [&](unsigned seed) {
        std::mt19937 random(seed);
        check(one_of(with_kernel, seed),
              Words{"monaghan", "w2", "w4", "w5", "w6", "w7", "w8"}[random() % 7], 1);
    });
}

// What is known of a default is not claimed where an option makes it another case, and default steps follow what
// options make stiffer.
BOOST_AUTO_TEST_CASE(no_check_must_fail_for_a_legal_option) {
    const std::vector<std::pair<std::string, Words>> all{
        {"counter_rotating", {"--smoke", "--dt", "0.3"}},
        {"algorithm_sweep", {"--smoke", "--dt", "0.3"}},
        {"algorithm_sweep", {"--smoke", "--speed", "0.5"}},
        {"relaxation", {"--smoke", "--lobes", "12", "--depth", "0.6"}},
        {"plastic_block", {"--smoke", "--yield", "smooth"}},
        {"sheared_square", {"--smoke", "--viscosity", "10"}},
        {"isomorphism", {"--smoke", "--law", "lucy", "--perturbation", "1e-2"}},
        {"lattice_stability",
         {"--smoke", "--potential", "density", "--kernel", "w2", "--range", "2"}},
        {"md_fields", {"--smoke", "--system", "impact", "--kernel", "w2"}},
        {"loaded_bar", {"--tolerance", "1e-3"}},
        {"stability", {"--stress", "0", "--range", "2.5"}},
        {"diffusion_waves", {"--smoke", "--wave", "shear", "--range", "2.2"}},
        {"cantilever", {"--smoke", "--penalty", "100", "--t-end", "0.002"}},
        {"torsion", {"--columns", "3", "--penalty", "100", "--periods", "0.1"}},
        {"ball_plate", {"--smoke", "--model", "embedded_atom", "--strength", "1"}},
        {"gas_cloud", {"--dimension", "2", "--ranges", "ellipses", "--size", "4"}},
        {"couette", {"--compare", "--reynolds", "1", "--dry-run"}},
        {"taylor_green", {"--compare", "--reynolds", "1", "--dry-run"}},
        {"cavity", {"--compare", "--reynolds", "1", "--dry-run"}},
    };
    for (const auto& [program, options] : all) {
        const Scratch folder;
        Words words = options;
        words.emplace_back("--no-plots");
        const auto outcome = run(problem(program, words), {folder.path()});
        BOOST_TEST(outcome.status == 0,
                   program << " " << options.front() << ": " << outcome.out << outcome.err);
    }
}

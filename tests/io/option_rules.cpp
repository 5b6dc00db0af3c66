// SPDX-License-Identifier: GPL-3.0-or-later
// Rules of options: what has no meaning is refused where it was given, and else no part of the case.
#include "support/process.hpp"
#include "support/refusal.hpp"
#include <spam/core/error.hpp>
#include <spam/io/options.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

struct Target {
    double core = 0.0, core_range = 1.0, speed = 1.0, turns = 1.0;
    std::optional<double> t_end;
    std::optional<int> threads, figure;
    bool movie = false, plots = true;
    Options options{"test", "a test"};

    Target() {
        options.number("core", core, "c", non_negative());
        options.number("core-range", core_range, "r", positive())
            .only_when(
                {"core"}, [this] { return core > 0.0; }, "needs a core");
        options.number("speed", speed, "v", positive());
        options.number("turns", turns, "n", positive());
        options.number("t-end", t_end, "t", positive());
        options.one_of({"turns", "t-end"}, "the end");
        options.integer("figure", figure, "f", between(1, 9)).excludes({"speed"});
        options.flag("plots", plots, "p");
        options.flag("movie", movie, "m").needs("figure");
        options.integer("threads", threads, "j", between(1, 64)).or_word("auto");
    }
    std::string refusal(const Words& words) {
        std::vector<const char*> arguments{"test"};
        for (const auto& word : words) arguments.push_back(word.c_str());
        return test::refusal([&] {
            options.parse(static_cast<int>(arguments.size()), arguments.data());
            options.settle();
        });
    }
};

std::string refusal(const Words& words) { return Target().refusal(words); }

/// A problem of lengths in mm.
double radius_of(const Words& words, std::string* file = nullptr) {
    double radius = 3.2;
    Options options("test", "a test");
    options.number("radius", radius, "of the bar", positive()).unit("mm");
    std::vector<const char*> arguments{"test"};
    for (const auto& word : words) arguments.push_back(word.c_str());
    options.parse(static_cast<int>(arguments.size()), arguments.data());
    options.settle();
    if (file != nullptr) *file = options.case_toml();
    return radius;
}

/// Whether the case holds an option, when these words are given.
bool holds(const std::string& option, const Words& words) {
    Target target;
    BOOST_TEST(target.refusal(words) == "accepted");
    return target.options.case_toml().find("\n" + option + " = ") != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(without_meaning_refused_or_left_out) {
    BOOST_TEST(refusal({"--core-range", "2"}) == "core-range: needs a core");
    BOOST_TEST(refusal({"--core-range", "2", "--core", "0.1"}) == "accepted");
    BOOST_TEST(!holds("core-range", {}));
    BOOST_TEST(holds("core-range", {"--core", "0.1"}));
}

BOOST_AUTO_TEST_CASE(needs_and_excludes) {
    BOOST_TEST(refusal({"--movie"}) ==
               "movie: has no meaning without --figure; add it, or leave this one out");
    BOOST_TEST(refusal({"--movie", "--figure", "2"}) == "accepted");
    BOOST_TEST(refusal({"--figure", "2", "--speed", "1"}) ==
               "speed: --figure 2 settles it; leave one out");
    BOOST_TEST(!holds("speed", {"--figure", "2"}));
    BOOST_TEST(holds("speed", {}));
}

BOOST_AUTO_TEST_CASE(one_of_several) {
    BOOST_TEST(refusal({"--turns", "2", "--t-end", "3"}) ==
               "t-end: --turns sets the end too; leave one out");
    BOOST_TEST((holds("turns", {}) && !holds("t-end", {})));
    BOOST_TEST((!holds("turns", {"--t-end", "3"}) && holds("t-end", {"--t-end", "3"})));
}

BOOST_AUTO_TEST_CASE(the_command_line_wins_over_a_file) {
    const Scratch folder;
    const auto file = [&](const std::string& toml, Words words) {
        folder.write("case.toml", toml);
        words.insert(words.end(), {"--config", (folder / "case.toml").string()});
        Target target;
        const std::string refused = target.refusal(words);
        return refused == "accepted" ? target.options.case_toml() : refused;
    };
    // Either end, whatever the file says.
    BOOST_TEST(file("turns = 2", {"--t-end", "7"}).find("t-end = 7") != std::string::npos);
    BOOST_TEST(file("turns = 2", {"--t-end", "7"}).find("turns") == std::string::npos);
    BOOST_TEST(file("t-end = 7", {"--turns", "2"}).find("t-end") == std::string::npos);
    BOOST_TEST(file("t-end = 7\nturns = 2", {}).starts_with("t-end: "));
    // What decides, but not what is decided.
    BOOST_TEST(file("core = 1\ncore-range = 2", {"--core", "0"}).find("core-range") ==
               std::string::npos);
    BOOST_TEST(file("core = 0", {"--core-range", "2"}) == "core-range: needs a core");
    BOOST_TEST(file("core-range = 2", {}) == "core-range: needs a core");
}

BOOST_AUTO_TEST_CASE(a_number_or_a_word) {
    for (const Words& words : {Words{}, {"--threads", "auto"}, {"--threads", "3"}}) {
        Target target;
        BOOST_TEST(target.refusal(words) == "accepted");
        BOOST_TEST((target.threads ==
                    (words.size() == 2 && words[1] == "3" ? std::optional(3) : std::nullopt)));
    }
    BOOST_TEST(refusal({"--threads", "many"}) ==
               "threads: 'many' must be \"auto\", or a whole number, between 1 and 64");
}

BOOST_AUTO_TEST_CASE(at_default) {
    Target target;
    BOOST_TEST(target.refusal({"--speed", "1.0", "--core", "0.1"}) == "accepted");
    BOOST_TEST(target.options.at_default({"speed", "turns", "t-end", "threads", "movie"}));
    BOOST_TEST(!target.options.at_default({"speed", "core"}));
    target.speed = 2.0;  // what the program makes of it later is not what was asked for
    BOOST_TEST(target.options.at_default({"speed"}));
    BOOST_CHECK_THROW(static_cast<void>(target.options.at_default({"sped"})), std::logic_error);
}

/// The unit of an option may stand behind its number; another one is refused, not converted.
BOOST_AUTO_TEST_CASE(numbers_with_their_unit) {
    for (const char* text : {"0.4", "0.4mm", "0.4 mm", "4e-1  mm"})
        BOOST_TEST(radius_of({"--radius", text}) == 0.4, text);
    for (const char* text : {"0.4 m", "0.4 µm", "0.4 mm mm", "mm", "0.4 MM"})
        BOOST_CHECK_EXCEPTION(radius_of({"--radius", text}), InputError, [](const auto& error) {
            return std::string(error.what()).ends_with("must be a number above 0 (in mm)");
        });
    std::string file;
    radius_of({"--radius", "7 mm"}, &file);
    BOOST_TEST(file.ends_with("radius = 7  # mm\n"));
}

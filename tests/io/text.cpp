// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/text.hpp>
#include <spam/io/options.hpp>
#include <spam/io/results.hpp>
#include <spam/io/terminal.hpp>

#include <boost/test/unit_test.hpp>

#include <limits>
#include <sstream>

using namespace spam;

BOOST_AUTO_TEST_CASE(lines_wrap_under_their_text) {
    BOOST_TEST(wrap("short", 20) == "short");
    BOOST_TEST(wrap("key     one two three four", 22) == "key     one two three\n     four");
    BOOST_TEST(wrap("key     one two three four five six", 32) ==
               "key     one two three four five\n        six");
    BOOST_TEST(wrap("one two three", 8) == "one two\n  three");
    BOOST_TEST(wrap("a_word_longer_than_the_line b", 10) ==
               "a_word_lon\n  ger_than\n  _the_lin\n  e b");
    BOOST_TEST(wrap("", 10).empty());
    const std::string no_letters(100, '\x80');  // bytes that only go on with one
    BOOST_TEST(wrap("key     " + no_letters, 22).size() > no_letters.size());
    const std::string text =
        "promise     mass exact, momentum exact, angular momentum to integrator error";
    for (std::size_t width = 30; width < 90; ++width) {
        std::istringstream lines(wrap(text, width));
        for (std::string line; std::getline(lines, line);) BOOST_TEST(line.size() <= width);
    }
}

namespace {

struct Target {
    double x = 1.5;
    std::optional<double> y;
    int n = 3;
    bool on = false;
    std::string name = "a\"b";
    Options options{"test", "a test"};

    Target() {
        options.number("x-value", x, "x", positive());
        options.number("y-value", y, "y", any_number());
        options.integer("count", n, "n", between(1, 9));
        options.flag("on", on, "a switch");
        options.text("name", name, "a name");
    }
    bool parse(std::vector<const char*> words) {
        words.insert(words.begin(), "test");
        return options.parse(static_cast<int>(words.size()), words.data());
    }
};

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_have_one_sign_and_nothing_else) {
    BOOST_TEST(number_in("+2.5e1").value() == 25.0);
    BOOST_TEST(number_in("-.5").value() == -0.5);
    BOOST_TEST(whole_number_in("+7").value() == 7);
    for (const char* word : {"", "+", "-", "+-5", "-+5", "++5", "--5", "5 ", " 5", "5x", "nan",
                             "inf", "-inf", "1e999", "1e-999", "0x10", "1,5"}) {
        BOOST_TEST(!number_in(word), word);
        BOOST_TEST(!whole_number_in(word), word);
    }
    for (const char* word : {"2.0", "1e3", "99999999999"}) BOOST_TEST(!whole_number_in(word), word);
}

BOOST_AUTO_TEST_CASE(flags_have_all_their_values_looked_at) {
    for (const std::vector<const char*>& words :
         {std::vector{"--on="}, {"--on=x", "--on"}, {"--on", "--on="}, {"--on=1"}}) {
        Target t;
        BOOST_CHECK_THROW(t.parse(words), InputError);
    }
    Target t;
    BOOST_TEST(t.parse({"--on=true"}));
    BOOST_TEST(t.on);
    Target other;
    BOOST_TEST(other.parse({"--on=false"}));
    BOOST_TEST(!other.on);
}

BOOST_AUTO_TEST_CASE(options_reach_their_targets) {
    Target t;
    BOOST_TEST(t.parse({"--x-value", "2.5e1", "--y-value=-3", "--count", "9", "--on"}));
    BOOST_TEST(t.x == 25.0);
    BOOST_TEST(*t.y == -3.0);
    BOOST_TEST(t.n == 9);
    BOOST_TEST(t.on);
    BOOST_TEST(t.options.given("x-value"));
    BOOST_TEST(!t.options.given("name"));
    BOOST_TEST(t.options.first_given({"name", "count", "on"}) == "count");
}

BOOST_AUTO_TEST_CASE(the_case_written_back_is_the_case) {
    Target t;
    t.parse({"--x-value", "0.1"});
    t.options.leave_out({"on"});
    const std::string toml = t.options.case_toml();
    BOOST_TEST((toml.find("x-value = 0.1\n") != std::string::npos), toml);
    BOOST_TEST((toml.find("count = 3\n") != std::string::npos), toml);
    BOOST_TEST((toml.find("name = \"a\\\"b\"\n") != std::string::npos), toml);
    BOOST_TEST((toml.find("y-value") == std::string::npos), toml);  // unset
    BOOST_TEST((toml.find("on =") == std::string::npos), toml);     // left out
}

BOOST_AUTO_TEST_CASE(wrong_values_are_refused) {
    for (const char* value : {"0", "-1", "nan", "inf", "1e400", "abc", "", "1.5x", " 1", "0x10"})
        BOOST_CHECK_THROW(Target{}.parse({"--x-value", value}), InputError);
    for (const char* value : {"0", "10", "2.5", "1e0", "99999999999", ""})
        BOOST_CHECK_THROW(Target{}.parse({"--count", value}), InputError);
}

BOOST_AUTO_TEST_CASE(checks_hold_or_not) {
    BOOST_TEST((Check{"a", 1.05, 1.0, 0.1, ""}.holds()));
    BOOST_TEST((!Check{"a", 1.2, 1.0, 0.1, ""}.holds()));
    BOOST_TEST((!Check{"a", std::numeric_limits<double>::quiet_NaN(), 1.0, 0.1, ""}.holds()));
    BOOST_TEST((Check{"a", 1.2, {}, 0.0, ""}.holds()));  // nothing claimed
}

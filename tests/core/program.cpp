// SPDX-License-Identifier: GPL-3.0-or-later
// Other programs: where they are, where they work, how they end and what they say of errors.
#include "support/process.hpp"
#include <spam/core/program.hpp>

#include <boost/test/unit_test.hpp>

using spam::Command;
using spam::find_program;
using spam::test::contents_of;
using spam::test::Scratch;

BOOST_AUTO_TEST_CASE(programs_are_found_on_path) {
    BOOST_TEST(find_program("sh").filename() == "sh");
    BOOST_TEST(find_program("no-such-program").empty());
    BOOST_TEST(find_program("").empty());  // a folder is none
}

BOOST_AUTO_TEST_CASE(a_command_works_in_its_folder) {
    const Scratch scratch;
    scratch.write("words", "some");
    BOOST_TEST((Command{{"cp", "words", "copy"}, scratch.path()}.run() == 0));
    BOOST_TEST(contents_of(scratch / "copy") == "some");
    BOOST_TEST((!Command{{"cp", "words", "copy"}, scratch / "no-such-folder"}.run()));
}

BOOST_AUTO_TEST_CASE(its_end_is_told) {
    BOOST_TEST((Command{{"sh", "-c", "exit 7"}}.run() == 7));
    BOOST_TEST((!Command{{"no-such-program"}}.run()));
    BOOST_TEST((!Command{{"sh", "-c", "kill -9 $$"}}.run()));
    // No terminal to ask, no word left out.
    BOOST_TEST((Command{{"sh", "-c", "read line || exit 3"}}.run() == 3));
    BOOST_TEST((Command{{"sh", "-c", "test \"$1\" = 'a b'", "sh", "a b"}}.run() == 0));
}

BOOST_AUTO_TEST_CASE(what_it_says_of_errors_is_kept) {
    const Scratch scratch;
    BOOST_TEST(
        (Command{{"sh", "-c", "echo no; echo so >&2; exit 1"}, {}, scratch / "said"}.run() == 1));
    BOOST_TEST(contents_of(scratch / "said") == "so\n");
}

// SPDX-License-Identifier: GPL-3.0-or-later
// A sweep that is stopped in the middle, by whatever, goes on with the same command.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>

#include <thread>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

const Words sweep{"--size", "2",   "--turns",    "1",      "--speed", "0.2",
                  "--dt",   "0.1", "--no-plots", "--jobs", "2"};

Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Outcome run_in(const Scratch& folder, const Words& arguments) {
    return Child(problem("algorithm_sweep", arguments), {folder.path()})
        .finish(Child::Seconds(600));
}

/// The table without its last column, seconds.
std::string without_seconds(const std::string& table) {
    std::string text;
    std::size_t begin = 0;
    for (std::size_t end; (end = table.find('\n', begin)) != std::string::npos; begin = end + 1)
        text += table.substr(begin, table.rfind(',', end) - begin) + '\n';
    return text;
}

std::size_t lines(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) return 0;
    const std::string text = contents_of(file);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

BOOST_AUTO_TEST_CASE(killed_and_started_again_it_finishes_with_the_same_table) {
    const Scratch folder;
    const Outcome whole = run_in(folder, with(sweep, {"--out", "whole"}));
    BOOST_REQUIRE_MESSAGE(whole.status == 0, whole.out << whole.err);
    const std::string expected = without_seconds(contents_of(folder / "whole/sweep.csv"));
    BOOST_TEST(lines(folder / "whole/sweep.csv") == 73u);

    for (const std::size_t rows : {5u, 30u, 55u}) {  // killed again and again
        Child child(problem("algorithm_sweep", with(sweep, {"--out", "killed"})), {folder.path()});
        child.wait_for(
            [&](const Outcome&) { return lines(folder / "killed/sweep.part.csv") > rows; });
        child.send(SIGKILL);
        BOOST_TEST(child.finish().signal == SIGKILL);
        BOOST_TEST(!std::filesystem::exists(folder / "killed/sweep.csv"));
    }
    const Outcome again = run_in(folder, with(sweep, {"--out", "killed"}));
    BOOST_REQUIRE_MESSAGE(again.status == 0, again.out << again.err);
    BOOST_TEST(again.out.find("are known already") != std::string::npos);
    BOOST_TEST(without_seconds(contents_of(folder / "killed/sweep.csv")) == expected);
    BOOST_TEST(!std::filesystem::exists(folder / "killed/sweep.part.csv"));
}

BOOST_AUTO_TEST_CASE(an_unfinished_sweep_is_not_continued_with_another_case) {
    const Scratch folder;
    Child child(problem("algorithm_sweep", with(sweep, {"--out", "out"})), {folder.path()});
    child.wait_for([&](const Outcome&) { return lines(folder / "out/sweep.part.csv") > 5; });
    child.send(SIGINT);
    const Outcome interrupted = child.finish();
    BOOST_TEST(interrupted.status == 130);
    BOOST_TEST(interrupted.err.find("the results so far are complete") != std::string::npos);
    const std::string before = contents_of(folder / "out/sweep.part.csv");

    const auto digit = before.rfind(",deformed") - 1;  // of the last row that survived
    for (const char* damage : {"9x", "", ","}) {
        std::string text = before;
        text.replace(digit, 1, damage);
        folder.write("out/sweep.part.csv", text);
        const Outcome damaged = run_in(folder, with(sweep, {"--out", "out"}));
        BOOST_TEST(damaged.status == 2);
        for (const char* word : {"sweep.part.csv' line ", "column 'turns_survived'", "--force"})
            BOOST_TEST(damaged.err.find(word) != std::string::npos, damaged.err);
        BOOST_TEST(contents_of(folder / "out/sweep.part.csv") == text);
    }
    folder.write("out/sweep.part.csv", before);

    const Outcome other = run_in(folder, with(sweep, {"--out", "out", "--viscosity", "2"}));
    BOOST_TEST(other.status == 2);
    BOOST_TEST(other.err.find("another case") != std::string::npos);
    BOOST_TEST(contents_of(folder / "out/sweep.part.csv") == before);
}

BOOST_AUTO_TEST_CASE(a_finished_sweep_is_not_overwritten) {
    const Scratch folder;
    const Words smoke{"--smoke", "--no-plots"};
    BOOST_TEST(run_in(folder, smoke).status == 0);
    const Outcome again = run_in(folder, smoke);
    BOOST_TEST(again.status == 2);
    BOOST_TEST(again.err.find("--force") != std::string::npos);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// What a run looks like: on terminals of any width, through a pipe, and with --quiet.
#include "problem/screen.hpp"
#include "support/process.hpp"
#include <spam/io/terminal.hpp>

#include <boost/test/unit_test.hpp>
#include <sys/resource.h>

#include <chrono>
#include <thread>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

constexpr std::string_view erase = "\r\x1b[K";

Outcome shown(const Scratch& folder, unsigned short columns, const Words& arguments) {
    return run(problem("rotating_hexagon", arguments), {folder.path(), columns});
}

/// Progress is drawn in place while it runs, and gone at the end.
void check_progress(const Outcome& outcome) {
    BOOST_TEST(outcome.out.find(" %  t ") != std::string::npos);
    BOOST_TEST(outcome.out.find(erase) != std::string::npos);
    BOOST_TEST(!Screen(outcome.out).shows(" %  t "));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_screen_of_this_test_shows_what_a_terminal_would) {
    const Screen screen("one\r\ntwo three\rT\r\x1b[Kλμ!\nlast");
    BOOST_TEST(screen.lines().size() == 3u);
    BOOST_TEST(screen.lines()[0] == "one");
    BOOST_TEST(screen.lines()[1].size() == 3u);
    BOOST_TEST(screen.widest() == 9u);
    BOOST_CHECK_THROW(Screen("\x1b[2J"), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(no_line_is_wider_than_the_terminal) {
    for (const unsigned short columns : std::vector<unsigned short>{20, 40, 60, 79, 80, 200}) {
        for (const Words& arguments :
             {Words{"--smoke", "--no-plots", "--t-end", "1"}, Words{"--dry-run"},
              Words{"--smoke", "--no-plots", "--t-end", "1", "--transport", "average",
                    "--integrator", "arkode:DORMAND_PRINCE_7_4_5", "--out",
                    "a_rather_long_name_of_a_folder"}}) {
            const Scratch folder;
            const Outcome outcome = shown(folder, columns, arguments);
            BOOST_TEST_CONTEXT(columns << " columns, " << arguments[0] << "\n" << outcome.out) {
                BOOST_TEST(outcome.status == 0);
                BOOST_TEST(Screen(outcome.out).widest() <= columns);
                if (arguments[0] == "--smoke") check_progress(outcome);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_wide_terminal_is_used) {
    const Scratch folder;
    const Outcome outcome = shown(folder, 200, {"--dry-run"});
    BOOST_TEST(Screen(outcome.out).widest() > 100u);
}

BOOST_AUTO_TEST_CASE(sixty_columns_tell_everything_that_matters) {
    const Scratch folder;
    const Outcome outcome = shown(folder, 60, {"--smoke", "--no-plots", "--transport", "monaghan"});
    const Screen screen(outcome.out);
    for (const char* words :
         {"command     rotating_hexagon", "particles   37", "model       smooth",
          "promise     mass exact", "integrator  rk4", "invariant", "kept", "189 steps", "checks",
          "ok    energy_drift", "results in"})
        BOOST_TEST(screen.shows(words), "no '" << words << "' in\n" << outcome.out);
    for (const auto& line : screen.lines()) BOOST_TEST(!line.ends_with(' '), "'" << line << "'");
}

BOOST_AUTO_TEST_CASE(the_progress_line_says_percent_time_left_drifts_step_and_rejections) {
    const Scratch folder;
    const auto line_of = [&](Words words) {
        words.insert(words.end(), {"--smoke", "--no-plots", "--transport", "monaghan", "--force"});
        const Outcome outcome = shown(folder, 100, words);
        const std::size_t at = outcome.out.find(" %  t ");
        BOOST_REQUIRE(at != std::string::npos);
        return outcome.out.substr(at, outcome.out.find(erase, at) - at);
    };
    const std::string line = line_of({"--integrator", "arkode:DORMAND_PRINCE_7_4_5"});
    for (const char* words : {"t ", "left ", "dE ", "dL ", "dt ", "rejected "})
        BOOST_TEST(line.find(words) != std::string::npos, "no '" << words << "' in " << line);
    const std::string fixed = line_of({});  // of steps that are what they were told to be
    for (const char* words : {"dt ", "rejected "})
        BOOST_TEST(fixed.find(words) == std::string::npos, fixed);
}

BOOST_AUTO_TEST_CASE(through_a_pipe_there_are_plain_lines) {
    const Scratch folder;
    const Outcome outcome = shown(folder, 0, {"--smoke", "--no-plots", "--transport", "monaghan"});
    BOOST_TEST(outcome.status == 0);
    BOOST_TEST(outcome.err == "");
    BOOST_TEST(outcome.out.find('\x1b') == std::string::npos);
    BOOST_TEST(outcome.out.find('\r') == std::string::npos);
    const Screen screen(outcome.out);
    for (const char* words : {"100 %  t ", "results in"})
        BOOST_TEST(screen.shows(words), "no '" << words << "'");
}

/// Lines of progress: few in a second, however many tenths pass in it, the last one always.
BOOST_AUTO_TEST_CASE(progress_is_told_no_faster_than_it_is_read) {
    const auto lines_in = [](std::chrono::milliseconds pause) {
        const Scratch folder;
        spam::Terminal terminal(true);
        terminal.log_to(folder / "run.log");
        terminal.begin_progress();
        for (int percent = 1; percent <= 100; ++percent) {
            const double fraction = 0.01 * percent;
            if (terminal.progress_due(fraction)) terminal.progress(fraction, "line");
            std::this_thread::sleep_for(pause);
        }
        const std::string log = contents_of(folder / "run.log");
        return std::count(log.begin(), log.end(), '\n');
    };
    using std::chrono::milliseconds;
    BOOST_TEST(lines_in(milliseconds(0)) == 1);
    const auto of_a_second = lines_in(milliseconds(10));
    BOOST_TEST(of_a_second >= 2);
    BOOST_TEST(of_a_second <= 4);  // with a busy machine
    BOOST_TEST(lines_in(milliseconds(45)) == 10);
}

/// Of several cases the last line says where their rows are.
BOOST_AUTO_TEST_CASE(the_last_line_says_where_rows_are) {
    const Scratch folder;
    const Outcome outcome = shown(folder, 200, {"--smoke", "--no-plots", "--t-end", "1"});
    BOOST_TEST(Screen(outcome.out).shows("md/, plain/, monaghan/, monaghan_torque_pair/"),
               outcome.out);
    const Outcome one = shown(
        folder, 200, {"--smoke", "--no-plots", "--t-end", "1", "--model", "md", "--out", "one"});
    BOOST_TEST(!Screen(one.out).shows("rows of each case"), one.out);
}

BOOST_AUTO_TEST_CASE(quiet_is_quiet_on_a_terminal_too) {
    for (const unsigned short columns : std::vector<unsigned short>{0, 60}) {
        const Scratch folder;
        const Outcome outcome =
            shown(folder, columns, {"--smoke", "--no-plots", "--t-end", "1", "--quiet"});
        BOOST_TEST(outcome.status == 0);
        BOOST_TEST(outcome.out == "");
        BOOST_TEST(outcome.err == "");
    }
}

/// The keys, not a signal sent by a program: the terminal itself sends it.
BOOST_AUTO_TEST_CASE(control_c_leaves_a_tidy_screen) {
    const Scratch folder;
    Child child(
        problem("rotating_hexagon", {"--transport", "monaghan", "--turns", "50", "--no-plots"}),
        {folder.path(), 60});
    BOOST_REQUIRE(child.wait_for(
        [](const Outcome& so_far) { return so_far.out.find(" %  t ") != std::string::npos; }));
    BOOST_REQUIRE(child.type("\x03"));
    const Outcome outcome = child.finish();
    BOOST_TEST(outcome.status == 130);
    const Screen screen(outcome.out);
    BOOST_TEST(!screen.shows(" %  t "), outcome.out);
    BOOST_TEST(screen.shows("interrupted by signal 2"));
    BOOST_TEST(screen.widest() <= 60u + 2u);  // the terminal itself adds ^C
    BOOST_TEST(screen.lines().back() == "");  // the prompt begins a line
}

BOOST_AUTO_TEST_CASE(an_error_does_not_follow_on_the_progress_line) {
    const Scratch folder;
    Launch launch{folder.path(), 80};
    launch.before_exec = [] {  // the table cannot grow: a full disk
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{12000, 12000};
        setrlimit(RLIMIT_FSIZE, &limit);
    };
    const Outcome outcome =
        run(problem("rotating_hexagon", {"--smoke", "--transport", "plain", "--no-plots"}), launch);
    BOOST_TEST(outcome.status == 4);
    const Screen screen(outcome.out);
    BOOST_TEST(!screen.shows(" %  t "), outcome.out);
    BOOST_TEST(
        screen.lines().at(screen.lines().size() - 2).starts_with("rotating_hexagon: cannot"));
}

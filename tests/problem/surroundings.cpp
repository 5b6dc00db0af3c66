// SPDX-License-Identifier: GPL-3.0-or-later
// A run among other programs: descriptors closed by the program that started it, readers that leave, bare
// environments, little memory. None of it spoils results or turns into a crash.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

const Words short_run{"--size", "2",          "--t-end", "4",  "--transport",
                      "plain",  "--no-plots", "--out",   "out"};

Outcome run_with_closed(const Scratch& folder, const Words& arguments,
                        const std::vector<int>& descriptors) {
    Launch launch{folder.path()};
    launch.before_exec = [&] {
        for (const int descriptor : descriptors) close(descriptor);
    };
    return run(problem("rotating_hexagon", arguments), launch);
}

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// The program within a shell pipeline; the status is that of the program, not of the pipeline.
Outcome run_in_shell(const Scratch& folder, const Words& arguments, const std::string& pipeline) {
    std::string command = "{ ";
    for (const auto& word : problem("rotating_hexagon", arguments)) command += "'" + word + "' ";
    return run({"sh", "-c", command + "; echo $? >&2; } " + pipeline}, {folder.path()});
}

}  // namespace

/// A file must never be opened as descriptor 1 and receive what was meant for the terminal.
BOOST_AUTO_TEST_CASE(closed_descriptors_do_not_mix_text_into_results) {
    const Scratch reference;
    BOOST_TEST(run(problem("rotating_hexagon", short_run), {reference.path()}).status == 0);
    for (const auto& closed : {std::vector<int>{1}, std::vector<int>{0, 1, 2}}) {
        const Scratch folder;
        BOOST_TEST(run_with_closed(folder, short_run, closed).status == 0);
        BOOST_CHECK_NO_THROW(Csv(folder / "out/invariants.csv"));
        for (const char* name : {"out/invariants.csv", "out/snapshots.pvd", "out/result.json"})
            BOOST_TEST((contents_of(folder / name) == contents_of(reference / name)), name);
        BOOST_TEST(lines(contents_of(folder / "out/run.log")) ==
                   lines(contents_of(reference / "out/run.log")));
    }
}

BOOST_AUTO_TEST_CASE(the_status_tells_it_where_no_line_can) {
    const Scratch folder;
    BOOST_TEST(run_with_closed(folder, {"--size", "0"}, {2}).status == 2);
    const auto program = problem("rotating_hexagon", {}).front();
    BOOST_TEST(run({"sh", "-c", "'" + program + "' --size 0 2>/dev/full"}).status == 2);
    BOOST_TEST(run_with_closed(folder, {"--help"}, {1}).status == 0);
}

BOOST_AUTO_TEST_CASE(a_reader_that_leaves_does_not_end_the_run) {
    const Scratch folder;
    const Outcome outcome = run_in_shell(folder, short_run, "| head -n 1");
    BOOST_TEST(lines(outcome.out) == 1u);
    BOOST_TEST(outcome.err == "0\n");
    BOOST_TEST(json_of(folder / "out/result.json").is_array());
}

BOOST_AUTO_TEST_CASE(nowhere_to_print) {
    const Scratch folder;
    const Outcome outcome = run_in_shell(folder, short_run, ">/dev/full");
    BOOST_TEST(outcome.err == "0\n");
    BOOST_TEST(json_of(folder / "out/result.json").is_array());
}

BOOST_AUTO_TEST_CASE(no_environment) {
    const Scratch folder;
    Launch launch{folder.path()};
    launch.before_exec = [] { clearenv(); };
    BOOST_TEST(run(problem("rotating_hexagon", short_run), launch).status == 0);
}

BOOST_AUTO_TEST_CASE(a_file_of_options_through_a_pipe) {
    const Scratch folder;
    folder.write("case.toml", "size = 0\n");
    const auto program = problem("rotating_hexagon", {}).front();
    const Outcome outcome =
        run({"sh", "-c", "cat case.toml | '" + program + "' --config /dev/stdin"}, {folder.path()});
    BOOST_TEST(outcome.status == 2);
    BOOST_TEST(outcome.err.find("line 1: size") != std::string::npos, outcome.err);
}

BOOST_AUTO_TEST_CASE(files_of_options_from_elsewhere) {
    for (const std::string text : {"\xef\xbb\xbfsize = 3\r\nt-end = 1\r\ntransport = \"plain\"\r\n",
                                   "size = 3\nt-end = 1.0\ntransport = 'plain'",  // no last newline
                                   "# \u03bb\n'size' = 0x3\nt-end=1e0\n\ntransport=\"plain\"\n"}) {
        const Scratch folder;
        folder.write("case.toml", text);
        const Outcome outcome =
            run(problem("rotating_hexagon", {"--config", "case.toml", "--no-plots", "--out", "o"}),
                {folder.path()});
        BOOST_TEST(outcome.status == 0, outcome.err);
        BOOST_TEST(Csv(folder / "o/invariants.csv").column("t").back() == 1.0);
    }
}

BOOST_AUTO_TEST_CASE(too_many_threads_for_the_limits) {
#if SPAM_SANITIZED
    return;  // the sanitizer needs terabytes of addresses
#else
    const Scratch folder;
    Launch launch{folder.path()};
    launch.before_exec = [] {
        const rlimit addresses{600u << 20, 600u << 20}, stack{8u << 20, 8u << 20};
        setrlimit(RLIMIT_STACK, &stack);
        setrlimit(RLIMIT_AS, &addresses);
    };
    const Words many{"--size", "20", "--threads", "1000"};
    const Outcome outcome = run(problem("rotating_hexagon", many), launch);
    BOOST_TEST(outcome.status == 2);
    BOOST_TEST(outcome.err.starts_with("rotating_hexagon: threads: 1000 cannot be started, only "));
    BOOST_TEST(lines(outcome.err) == 1u);
    BOOST_TEST(folder.listing().empty());
#endif
}

BOOST_AUTO_TEST_CASE(too_many_particles_for_the_memory) {
#if SPAM_SANITIZED
    return;  // the sanitizer needs terabytes of addresses
#else
    const Scratch folder;
    Launch launch{folder.path()};
    launch.before_exec = [] {
        const rlimit limit{400u << 20, 400u << 20};
        setrlimit(RLIMIT_AS, &limit);
    };
    const Outcome outcome = run(
        problem("rotating_hexagon", {"--size", "2000", "--transport", "plain", "--smoke"}), launch);
    BOOST_TEST(outcome.status == 2);
    BOOST_TEST(lines(outcome.err) == 1u);
    BOOST_TEST(outcome.err.find("memory") != std::string::npos);
    BOOST_TEST(folder.listing().empty());
#endif
}

BOOST_AUTO_TEST_CASE(a_wrong_number_of_neighbours_ahead_is_refused) {
    for (const char* wrong : {"0", "3", "four"}) {
        const Scratch folder;
        Launch launch{folder.path()};
        launch.before_exec = [wrong] { setenv("SPAM_AHEAD", wrong, 1); };
        const Outcome outcome = run(problem("rotating_hexagon", short_run), launch);
        BOOST_TEST(outcome.status == 2);
        BOOST_TEST(lines(outcome.err) == 1U);
        BOOST_TEST(outcome.err.find("1, 2 or 4 neighbours ahead") != std::string::npos);
        BOOST_TEST(folder.listing().empty());
    }
}

BOOST_AUTO_TEST_CASE(the_instruction_set_is_named_and_can_be_chosen) {
    const auto run_with = [](const Scratch& folder, const char* set) {
        Launch launch{folder.path()};
        launch.before_exec = [set] { setenv("SPAM_ISA", set, 1); };
        return run(problem("rotating_hexagon", short_run), launch);
    };
    for (const char* wrong : {"v9", "x86-64-v3", "avx2"}) {
        const Scratch folder;
        const Outcome outcome = run_with(folder, wrong);
        BOOST_TEST(outcome.status == 2);
        BOOST_TEST(lines(outcome.err) == 1U);
        BOOST_TEST(outcome.err.find(wrong) != std::string::npos);
        BOOST_TEST(outcome.err.find("v2, v3 and v4") != std::string::npos);
        BOOST_TEST(folder.listing().empty());
    }
    const Scratch folder;
    const Outcome outcome = run_with(folder, "v2");
    const auto log = folder / "out/run.log";
    if (outcome.status == 0)
        BOOST_TEST(contents_of(log).find("x86-64-v2") != std::string::npos);
    else  // a processor of another kind
        BOOST_TEST(outcome.err.find("SPAM_ISA") != std::string::npos);
}

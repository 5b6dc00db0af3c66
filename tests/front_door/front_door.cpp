// SPDX-License-Identifier: GPL-3.0-or-later
// The front door ./spam in a tree of its own, with a stub in place of cmake: one signal ends a build at
// once and leaves nothing behind, a wrong option is refused before a build, and a program that is up to
// date runs for users that may not write. Installed it runs what lies beside it.
#include "support/process.hpp"

#include <boost/test/unit_test.hpp>
#include <sys/stat.h>

using namespace spam::test;
namespace fs = std::filesystem;

namespace {

/// A tree with one problem.
class Tree : public Scratch {
  public:
    explicit Tree(const std::string& seconds) {
        fs::permissions(path(), fs::perms(0755));
        fs::copy(SPAM_SOURCE "/spam", *this / "spam");
        fs::create_directories(*this / "src/front_door");
        fs::copy(SPAM_SOURCE "/src/front_door", *this / "src/front_door",
                 fs::copy_options::recursive);
        fs::create_directory(*this / "stubs");
        fs::copy(SPAM_SOURCE "/tests/front_door/cmake_stub", *this / "stubs/cmake");
        for (const char* file : {"CMakeLists.txt", "CMakePresets.json", "include/a.hpp",
                                 "src/a.cpp", "problems/CMakeLists.txt", "problems/drop.cpp"})
            write(file, "");
        write("takes", seconds);
    }
    std::vector<std::string> call(const std::vector<std::string>& words) const {
        std::vector<std::string> all{(*this / "spam").string()};
        all.insert(all.end(), words.begin(), words.end());
        return all;
    }
    Launch launch(bool stranger = false) const {
        const std::string tools = (*this / "stubs").string() + ":" + std::getenv("PATH");
        return {.folder = path(), .before_exec = [tools, stranger] {
                    setenv("PATH", tools.c_str(), 1);
                    unsetenv("CI");
                    if (stranger && geteuid() == 0 && setuid(65534) != 0) _exit(126);
                }};
    }
};

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

BOOST_AUTO_TEST_CASE(one_signal_ends_a_build) {
    for (const auto& [signal, status] : {std::pair{SIGTERM, 143}, {SIGINT, 130}, {SIGHUP, 129}}) {
        const Tree tree("100");
        Child child(tree.call({"run", "--no-install", "drop"}), tree.launch());
        BOOST_TEST_REQUIRE(child.wait_for([&](const Outcome& seen) {
            return has(seen.err, "building") && fs::exists(tree / "compiler") &&
                   !contents_of(tree / "compiler").empty();
        }));
        child.send(signal);
        const Outcome outcome = child.finish(Child::Seconds(30));
        BOOST_TEST(outcome.status == status, outcome.err);
        // A compiler left behind would hold the lock for its 100 seconds.
        tree.write("takes", "0");
        const Outcome again = run(tree.call({"run", "--no-install", "drop"}), tree.launch());
        BOOST_TEST(again.status == 0, again.err);
    }
}

BOOST_AUTO_TEST_CASE(a_failing_build_is_told) {
    const Tree tree("nonsense");
    const Outcome outcome = run(tree.call({"run", "--no-install", "drop"}), tree.launch());
    BOOST_TEST(outcome.status == 5);
    BOOST_TEST(has(outcome.err, "no luck"), outcome.err);
}

BOOST_AUTO_TEST_CASE(wrong_options_are_refused_before_a_build) {
    const Tree tree("0");
    for (const char* option : {"--typo", "rhs", "-x"}) {
        const Outcome outcome = run(tree.call({"bench", "--no-install", option}), tree.launch());
        BOOST_TEST(outcome.status == 2);
        BOOST_TEST(has(outcome.err, option), outcome.err);
        BOOST_TEST(!fs::exists(tree / "build"));
    }
}

BOOST_AUTO_TEST_CASE(python_without_a_script_is_refused_before_a_build) {
    const Tree tree("100");
    for (const auto& [words, said] :
         {std::pair{std::vector<std::string>{"python"}, "which script?"},
          {{"python", "nowhere.py"}, "no script 'nowhere.py'"}}) {
        const Outcome outcome = run(tree.call(words), tree.launch());
        BOOST_TEST(outcome.status == 2);
        BOOST_TEST(has(outcome.err, said), outcome.err);
    }
    BOOST_TEST(!fs::exists(tree / "build"));
}

BOOST_AUTO_TEST_CASE(a_program_that_is_up_to_date_runs_without_leave_to_write) {
    const Tree tree("0");
    BOOST_TEST(run(tree.call({"run", "--no-install", "drop"}), tree.launch()).status == 0);
    for (const char* folder : {"build/release/problems", "build/release"})
        fs::permissions(tree / folder, fs::perms(0555));
    const auto as_stranger = [&] {
        return run(tree.call({"run", "--no-install", "drop", "--smoke"}), tree.launch(true));
    };
    const Outcome outcome = as_stranger();
    BOOST_TEST(outcome.status == 0, outcome.err);
    BOOST_TEST(outcome.out == "ran --smoke\n");
    for (const char* source : {"src/a.cpp", "problems/drop.cpp", "include/a.hpp"}) {
        const auto built = fs::last_write_time(tree / "build/release/problems/drop");
        fs::last_write_time(tree / source, built + std::chrono::seconds(5));
        const Outcome refused = as_stranger();
        BOOST_TEST(refused.status == 5, source);
        BOOST_TEST(has(refused.err, "cannot write to"), refused.err);
        fs::last_write_time(tree / source, built - std::chrono::seconds(5));
    }
    fs::permissions(tree / "build/release", fs::perms(0755));
}

BOOST_AUTO_TEST_CASE(a_program_that_is_up_to_date_does_not_wait_for_another_build) {
    const Tree tree("0");
    BOOST_TEST(run(tree.call({"run", "--no-install", "drop"}), tree.launch()).status == 0);
    fs::remove(tree / "build/release/view/spam-view");
    tree.write("takes", "100");
    Child builds(tree.call({"view", "--no-install", "drop-out"}), tree.launch());
    BOOST_TEST_REQUIRE(
        builds.wait_for([&](const Outcome& seen) { return has(seen.err, "building"); }));
    Child runs(tree.call({"run", "drop", "--smoke"}), tree.launch());
    const Outcome outcome = runs.finish(Child::Seconds(30));
    BOOST_TEST(outcome.status == 0, outcome.err);
    BOOST_TEST(outcome.out == "ran --smoke\n");
    BOOST_TEST(!has(outcome.err, "waiting"), outcome.err);
    builds.send(SIGTERM);
    builds.finish(Child::Seconds(30));

    // Its commit is part of what a program says.
    tree.write(".git/logs/HEAD", "");
    tree.write("takes", "nonsense");
    BOOST_TEST(run(tree.call({"run", "--no-install", "drop"}), tree.launch()).status == 5);
}

BOOST_AUTO_TEST_CASE(pair_sums_are_compiled_for_this_processor_at_first_and_for_all_in_tests) {
    const Tree tree("0");
    const auto configured = [&] { return contents_of(tree / "configured"); };
    run(tree.call({"run", "--no-install", "drop"}), tree.launch());
    BOOST_TEST(has(configured(), "-DSPAM_LEVELS="), configured());
    BOOST_TEST(!has(configured(), "v2;v3"), configured());
    run(tree.call({"bench", "--no-install"}), tree.launch());
#if defined(__x86_64__)
    BOOST_TEST(has(configured(), "-DSPAM_LEVELS=v2;v3;v4"), configured());
#endif
}

BOOST_AUTO_TEST_CASE(view_is_built_and_gets_its_words) {
    const Tree tree("0");
    const Outcome empty = run(tree.call({"view"}), tree.launch());
    BOOST_TEST(empty.status == 2);
    BOOST_TEST(has(empty.err, "which results?"), empty.err);
    BOOST_TEST(!fs::exists(tree / "build"));
    const Outcome outcome =
        run(tree.call({"view", "--no-install", "drop-out", "--max-mb", "5"}), tree.launch());
    BOOST_TEST(outcome.status == 0, outcome.err);
    BOOST_TEST(outcome.out == "ran drop-out --max-mb 5\n");
}

BOOST_AUTO_TEST_CASE(installed_it_runs_what_lies_beside_it) {
    const Scratch prefix;
    const fs::path programs = prefix / "libexec/spam";
    prefix.write("libexec/spam/problems.txt", "drop   a drop (5 s)\n");
    prefix.write("libexec/spam/drop",
                 "#!/bin/sh\n[ $1 = --version ] && echo 'drop: spam 1.2.3' || echo \"drop $*\"\n");
    prefix.write("libexec/spam/spam-view", "#!/bin/sh\necho \"view $*\"\nexit 2\n");
    fs::copy(SPAM_SOURCE "/spam", programs / "spam");
    for (const char* program : {"drop", "spam-view"})
        fs::permissions(programs / program, fs::perms(0755));
    fs::create_directory(prefix / "bin");
    fs::create_symlink("../libexec/spam/spam", prefix / "bin/spam");
    const auto call = [&](std::vector<std::string> words) {
        words.insert(words.begin(), (prefix / "bin/spam").string());
        return run(words, {.folder = prefix.path()});
    };
    const auto before = prefix.listing();
    BOOST_TEST(call({"list"}).out == contents_of(programs / "problems.txt"));
    BOOST_TEST(call({"--version"}).out == "spam 1.2.3\n");
    BOOST_TEST(call({"run", "drop", "--smoke"}).out == "drop --smoke\n");
    const Outcome viewed = call({"view", "drop-out"});
    BOOST_TEST(viewed.out == "view drop-out\n");
    BOOST_TEST(viewed.status == 2);
    const Outcome misspelt = call({"run", "dorp"});
    BOOST_TEST(misspelt.status == 2);
    BOOST_TEST(has(misspelt.err, "did you mean drop?"), misspelt.err);
    for (const char* far : {"nosuch", "../x", "rotating"}) {
        const Outcome unknown = call({"run", far});
        BOOST_TEST(unknown.status == 2);
        BOOST_TEST(!has(unknown.err, "did you mean"), unknown.err);
    }
    const Outcome more = call({"list", "extra"});
    BOOST_TEST(more.status == 2);
    BOOST_TEST(has(more.err, "list: 'extra'?"), more.err);
    BOOST_TEST(!has(call({"help"}).out, "bench"));
    for (const char* verb : {"test", "bench"}) {
        const Outcome refused = call({verb});
        BOOST_TEST(refused.status == 2);
        BOOST_TEST(has(refused.err, "where SPAM is installed; there are run view list help\n"),
                   refused.err);
    }
    BOOST_TEST((prefix.listing() == before), "something was written");

    fs::remove(programs / "problems.txt");
    const Outcome alone = call({"list"});
    BOOST_TEST(alone.status == 2);
    BOOST_TEST(has(alone.err, "neither"), alone.err);
}

BOOST_AUTO_TEST_CASE(every_verb_is_in_the_help) {
    const Tree tree("0");
    const Outcome help = run(tree.call({"help"}), tree.launch());
    int verbs = 0;
    for (const auto& entry : fs::directory_iterator(SPAM_SOURCE "/src/front_door/verbs")) {
        const std::string line = "\n  ./spam " + entry.path().stem().string();
        BOOST_TEST(has(help.out, line.c_str()), line);
        ++verbs;
    }
    BOOST_TEST(verbs >= 2);
    BOOST_TEST(has(run(tree.call({"--version"}), tree.launch()).out, "spam "));
}

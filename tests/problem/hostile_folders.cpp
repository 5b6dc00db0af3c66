// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that go on in a folder from elsewhere write into that folder only: what would lead out of it, or keep the
// run waiting, is refused before anything is written.
#include "support/process.hpp"

#include <boost/test/unit_test.hpp>
#include <sys/stat.h>

#include <algorithm>

using namespace spam::test;
using Words = std::vector<std::string>;
namespace fs = std::filesystem;

namespace {

Outcome hexagon(const Scratch& folder, Words arguments) {
    arguments.emplace_back("--no-plots");
    return Child(problem("rotating_hexagon", arguments), {folder.path()})
        .finish(Child::Seconds(60));
}

/// A run of milliseconds in `out`, beside a file that belongs to another.
void make_run(const Scratch& folder) {
    folder.write("precious", "not yours");
    fs::create_directory(folder / "elsewhere");
    const Outcome outcome =
        hexagon(folder, {"--size", "1", "--transport", "plain", "--t-end", "0.2", "--out", "out"});
    BOOST_TEST_REQUIRE(outcome.status == 0, outcome.err);
}

void check_refused(const Outcome& outcome, const std::string& says) {
    BOOST_TEST(outcome.status == 2, outcome.err);
    BOOST_TEST(outcome.err.find(says) != std::string::npos, outcome.err);
    BOOST_TEST(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1, outcome.err);
}

std::map<std::string, std::string> without(std::map<std::string, std::string> all,
                                           const std::string& name) {
    all.erase(name);
    return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(links_and_pipes_are_refused) {
    const std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> kinds{
        {"a link", [](const fs::path& path) { fs::create_symlink("../precious", path); }},
        {"a link", [](const fs::path& path) { fs::create_symlink("../absent", path); }},
        {"a link", [](const fs::path& path) { fs::create_symlink("../elsewhere", path); }},
        {"neither", [](const fs::path& path) { mkfifo(path.c_str(), 0666); }}};
    const Scratch folder;
    make_run(folder);
    for (const auto& [kind, make] : kinds)
        for (const std::string name :
             {"invariants.csv", "events.csv", "run.log", "case.toml", "case.toml.tmp", "plots",
              "snapshot_0001.vtp.tmp", "checkpoint_0.h5.tmp", "deeper"}) {
            const fs::path path = folder / ("out/" + name);
            const bool there = fs::exists(path);
            if (there) fs::rename(path, folder / "kept");
            make(path);
            const auto before = without(folder.listing(), "out/" + name);
            BOOST_TEST_CONTEXT(name << " is " << kind) {
                const Outcome outcome = hexagon(folder, {"--restart", "out", "--t-end", "0.4"});
                // What leads nowhere is no log.
                const bool no_log = name == "run.log" && !fs::exists(path);
                check_refused(outcome, no_log ? "no run.log" : name + "' is " + kind);
                BOOST_TEST((without(folder.listing(), "out/" + name) == before));
            }
            fs::remove(path);
            if (there) fs::rename(folder / "kept", path);
        }
    // As it was it goes on; and so does a checkpoint in another folder.
    fs::create_symlink("../precious", folder / "out/letter");
    const Outcome elsewhere =
        hexagon(folder, {"--restart", "out", "--t-end", "0.4", "--out", "other"});
    BOOST_TEST(elsewhere.status == 0, elsewhere.err);
    fs::remove(folder / "out/letter");
    const Outcome here = hexagon(folder, {"--restart", "out", "--t-end", "0.4"});
    BOOST_TEST(here.status == 0, here.err);
    BOOST_TEST(contents_of(folder / "precious") == "not yours");
}

BOOST_AUTO_TEST_CASE(other_names_of_its_files_keep_their_contents) {
    const Scratch folder;
    make_run(folder);
    const std::vector<std::string> names{"invariants.csv", "run.log", "case.toml",
                                         "checkpoint_0.h5", "statistics.json"};
    std::map<std::string, std::string> before;
    for (const auto& name : names) {
        fs::create_hard_link(folder / ("out/" + name), folder / ("kept." + name));
        before[name] = contents_of(folder / ("kept." + name));
    }
    const Outcome outcome = hexagon(folder, {"--restart", "out", "--t-end", "0.4"});
    BOOST_TEST(outcome.status == 0, outcome.err);
    for (const auto& name : names) {
        BOOST_TEST((contents_of(folder / ("kept." + name)) == before[name]), name);
        BOOST_TEST((contents_of(folder / ("out/" + name)) != before[name]), name);
    }
    BOOST_TEST(contents_of(folder / "out/run.log").starts_with(before["run.log"]));
}

BOOST_AUTO_TEST_CASE(no_library_is_taken_from_the_working_folder) {
    const Scratch folder;
    const auto program = problem("couette", {"--help"});
    put_false_libraries(program.front(), folder);
    BOOST_TEST(folder.listing().size() > 5U);
    BOOST_TEST(run(program, {folder.path()}).status == 0);
}

/// A comparison is stopped between two of its runs, by one signal, and goes on in a folder that is its own.
BOOST_AUTO_TEST_CASE(one_signal_ends_a_study_between_runs) {
    const Scratch folder;
    folder.write("precious", "not yours");
    const Words words{"--compare", "--jobs", "1", "--no-plots", "--out", "out"};
    const fs::path rows = folder / "out/comparison.part.csv";
    const auto begin = [&] {
        return std::make_unique<Child>(problem("plastic_block", words), Launch{folder.path()});
    };
    {
        const auto child = begin();
        BOOST_REQUIRE(child->wait_for([&](const Outcome&) {
            if (!fs::exists(rows)) return false;
            const std::string text = contents_of(rows);
            return std::count(text.begin(), text.end(), '\n') > 1;
        }));
        child->send(SIGTERM);
        BOOST_TEST(child->finish().status == 143);
    }
    BOOST_TEST(fs::exists(rows));
    BOOST_TEST(!fs::exists(folder / "out/comparison.csv"));
    for (const std::string name : {"run.log", "statistics.json"}) {
        fs::rename(folder / ("out/" + name), folder / "kept");
        fs::create_symlink("../precious", folder / ("out/" + name));
        check_refused(begin()->finish(), name + "' is a link");
        fs::rename(folder / "kept", folder / ("out/" + name));
    }
    fs::remove(folder / "out/case.toml");
    mkfifo((folder / "out/case.toml").c_str(), 0666);
    check_refused(begin()->finish(), "case.toml' cannot be read");
    BOOST_TEST(contents_of(folder / "precious") == "not yours");
}

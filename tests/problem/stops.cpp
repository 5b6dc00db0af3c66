// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that end early: by a signal, a numerical guard or a full disk. Whatever the reason, the exit
// status tells it, one line says it, and the results so far are complete and readable.
#include "problem/result_files.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

/// Minutes long, with rows and configurations from the first second on.
const Words long_run{"--transport",      "monaghan", "--turns", "50",  "--output-every", "0.2",
                     "--snapshot-every", "5",        "--out",   "out", "--no-plots"};

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Rows of a table that is still being written.
std::size_t rows_so_far(const std::filesystem::path& csv) {
    return std::filesystem::exists(csv) ? lines(contents_of(csv)) : 0;
}

bool wait_for_rows(Child& child, const std::filesystem::path& csv, std::size_t rows) {
    return child.wait_for([&](const Outcome&) { return rows_so_far(csv) > rows; });
}

/// Every file of the results that exists can be read to its end, and none is half-written.
void check_readable(const Scratch& folder, const std::string& results) {
    Words there, listed;
    for (const auto& [name, text] : folder.listing()) {
        BOOST_TEST(!name.ends_with(".tmp"), name << " is left over");
        if (!name.starts_with(results + "/") || !name.ends_with(".vtp")) continue;
        there.push_back(name.substr(results.size() + 1));
        BOOST_CHECK_NO_THROW(Vtp(folder / name));
    }
    for (const auto& [t, name] : collection(folder / (results + "/snapshots.pvd")))
        listed.push_back(name);
    BOOST_TEST(there == listed, boost::test_tools::per_element());
    BOOST_CHECK_NO_THROW(Csv(folder / (results + "/invariants.csv")));
    BOOST_TEST(std::filesystem::exists(folder / (results + "/case.toml")));
}

/// ... and they hold the state at which the run stopped, and why.
void check_complete(const Scratch& folder, const std::string& reason) {
    check_readable(folder, "out");
    const auto statistics = json_of(folder / "out/statistics.json");
    BOOST_TEST(statistics.at("stopped").get<std::string>().find(reason) != std::string::npos,
               statistics["stopped"]);
    const double t_end = statistics.at("t_end").get<double>();
    const auto t = Csv(folder / "out/invariants.csv").column("t");
    for (std::size_t k = 1; k < t.size(); ++k) BOOST_TEST(t[k] > t[k - 1]);
    BOOST_TEST(t.back() == t_end);
    BOOST_TEST(collection(folder / "out/snapshots.pvd").back().first == t_end);
    BOOST_TEST(json_of(folder / "out/result.json").is_array());
    BOOST_TEST(contents_of(folder / "out/run.log").find(reason) != std::string::npos);
}

void check_interrupted(int signal, int status) {
    const Scratch folder;
    Child child(problem("rotating_hexagon", long_run), {folder.path()});
    BOOST_REQUIRE(wait_for_rows(child, folder / "out/invariants.csv", 3));
    child.send(signal);
    const Outcome outcome = child.finish();
    BOOST_TEST(outcome.status == status);
    BOOST_TEST(outcome.err.starts_with("rotating_hexagon: "));
    BOOST_TEST(lines(outcome.err) == 1u);
    check_complete(folder, "signal " + std::to_string(signal));
}

struct Unstable {
    Words arguments;
    Words says;
};

void check_stopped_by_guard(const Unstable& unstable) {
    const Scratch folder;
    Words arguments = unstable.arguments;
    arguments.insert(arguments.end(), {"--out", "out", "--no-plots"});
    const Outcome outcome = run(problem("rotating_hexagon", arguments), {folder.path()});
    BOOST_TEST_CONTEXT(arguments[0] << " " << arguments[1] << ": " << outcome.err) {
        BOOST_TEST(outcome.status == 3);
        BOOST_TEST(lines(outcome.err) == 1u);
        for (const auto& word : unstable.says)
            BOOST_TEST(outcome.err.find(word) != std::string::npos, "no '" << word << "'");
        check_complete(folder, unstable.says.front());
    }
}

/// No file may grow beyond this: what a full disk looks like, also to root.
Launch limited(const Scratch& folder, rlim_t bytes) {
    Launch launch{folder.path()};
    launch.before_exec = [bytes] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
    };
    return launch;
}

}  // namespace

BOOST_AUTO_TEST_CASE(interrupt) { check_interrupted(SIGINT, 130); }
BOOST_AUTO_TEST_CASE(terminate) { check_interrupted(SIGTERM, 143); }

/// timeout(1) sends a signal to its child and to the group of both.
BOOST_AUTO_TEST_CASE(two_signals_at_once_are_one) {
    const Scratch folder;
    Child child(problem("rotating_hexagon", long_run), {folder.path()});
    BOOST_REQUIRE(wait_for_rows(child, folder / "out/invariants.csv", 1));
    child.send(SIGTERM);
    child.send(SIGTERM);
    BOOST_TEST(child.finish().status == 143);
    check_complete(folder, "signal 15");
}

/// Many particles, so that the first snapshot is still being written when the first row is there.
BOOST_AUTO_TEST_CASE(between_the_first_row_and_the_first_snapshot) {
    for (int k = 0; k < 3; ++k) {
        const Scratch folder;
        Words arguments = long_run;
        arguments.insert(arguments.end(), {"--size", "80"});
        Child child(problem("rotating_hexagon", arguments), {folder.path()});
        BOOST_REQUIRE(wait_for_rows(child, folder / "out/invariants.csv", 1));
        child.send(SIGTERM);
        BOOST_TEST(child.finish().status == 143);
        check_complete(folder, "signal 15");
    }
}

BOOST_AUTO_TEST_CASE(the_comparison_interrupted) {
    const Scratch folder;
    Child child(
        problem("rotating_hexagon", {"--turns", "50", "--output-every", "0.2", "--out", "out"}),
        {folder.path()});
    BOOST_REQUIRE(wait_for_rows(child, folder / "out/md/invariants.csv", 3));
    child.send(SIGINT);
    const Outcome outcome = child.finish();
    BOOST_TEST(outcome.status == 130);
    BOOST_TEST(json_of(folder / "out/statistics.json").at("stopped") == "signal 2");
    BOOST_TEST(json_of(folder / "out/md/statistics.json").at("stopped") == "signal 2");
    BOOST_TEST(!std::filesystem::exists(folder / "out/plain"));  // no further case is begun
    BOOST_TEST(json_of(folder / "out/result.json").is_array());
    BOOST_CHECK_NO_THROW(Csv(folder / "out/md/invariants.csv"));
    for (const auto& [name, text] : folder.listing()) BOOST_TEST(!name.ends_with(".tmp"), name);
}

BOOST_AUTO_TEST_CASE(steps_that_are_too_long) {
    const std::string zonneveld = "arkode:ZONNEVELD_5_3_4";
    const std::vector<Unstable> table{
        {{"--dt", "10", "--transport", "plain", "--size", "3"}, {"density", "particle", "t = "}},
        {{"--dt", "3", "--model", "md", "--size", "3", "--turns", "2"},
         {"rate of velocity_x", "particle", "t = "}},
        // The first reason counts, whatever integrates: here too it is the density.
        {{"--dt", "10", "--transport", "plain", "--size", "3", "--integrator", zonneveld},
         {"density", "particle", "t = "}},
    };
    for (const auto& unstable : table) check_stopped_by_guard(unstable);
}

BOOST_AUTO_TEST_CASE(adaptive_steps_below_the_least) {
    check_stopped_by_guard({{"--size", "2", "--transport", "plain", "--integrator",
                             "arkode:DORMAND_PRINCE_7_4_5", "--rtol", "1e-14", "--atol", "1e-300"},
                            {"step", "t = "}});
}

/// Limits and sizes chosen so that, in turn, the table, the first configuration and the first checkpoint
/// cannot grow.
BOOST_AUTO_TEST_CASE(a_full_disk) {
    struct Full {
        rlim_t bytes;
        std::string size, names;
        bool configurations;  ///< one could be written
    };
    for (const auto& [bytes, size, names, configurations] :
         {Full{14000, "4", "invariants.csv", true}, Full{14000, "8", "snapshot_0000.vtp", false},
          Full{5000, "4", "checkpoint_0.h5", false}}) {
        const Scratch folder;
        const Outcome outcome =
            run(problem("rotating_hexagon", {"--smoke", "--transport", "plain", "--size", size,
                                             "--out", "out", "--no-plots"}),
                limited(folder, bytes));
        BOOST_TEST_CONTEXT(bytes << " bytes: " << outcome.err) {
            BOOST_TEST(outcome.status == 4);
            BOOST_TEST(lines(outcome.err) == 1u);
            BOOST_TEST(outcome.err.find(names) != std::string::npos);
            for (const auto& [name, text] : folder.listing())
                BOOST_TEST(!name.ends_with(".tmp"), name << " is left over");
            if (names == "checkpoint_0.h5") continue;  // before the first row
            BOOST_CHECK_NO_THROW(Csv(folder / "out/invariants.csv"));
            if (!configurations) continue;  // and no list of them
            check_readable(folder, "out");
            const auto statistics = json_of(folder / "out/statistics.json");
            BOOST_TEST(statistics.at("stopped").get<std::string>().find(names) !=
                       std::string::npos);
        }
    }
}

BOOST_AUTO_TEST_CASE(results_taken_away_during_the_run) {
    const Scratch folder;
    Words arguments = long_run;
    arguments.insert(arguments.end(), {"--size", "3"});
    Child child(problem("rotating_hexagon", arguments), {folder.path()});
    BOOST_REQUIRE(wait_for_rows(child, folder / "out/invariants.csv", 1));
    std::filesystem::rename(folder / "out", folder / "elsewhere");
    const Outcome outcome = child.finish();
    BOOST_TEST(outcome.status == 4);
    BOOST_TEST(lines(outcome.err) == 1u);
}

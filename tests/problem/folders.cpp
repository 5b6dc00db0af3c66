// SPDX-License-Identifier: GPL-3.0-or-later
// What a run leaves and where: pictures, old results moved aside, and the calls that write nothing.
#include "support/process.hpp"

#include <boost/test/unit_test.hpp>

#include <algorithm>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

Outcome hexagon(const Scratch& folder, const Words& arguments) {
    return run(problem("rotating_hexagon", arguments), {folder.path()});
}

/// A run of milliseconds.
Outcome short_run(const Scratch& folder, Words arguments = {}) {
    arguments.insert(arguments.end(), {"--size", "1", "--t-end", "0.2", "--transport", "plain"});
    return hexagon(folder, arguments);
}

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Files below a folder of the listing, as a listing of its own.
std::map<std::string, std::string> below(const Scratch& folder, const std::string& top) {
    std::map<std::string, std::string> part;
    for (const auto& [name, text] : folder.listing())
        if (name.starts_with(top + "/")) part[name.substr(top.size() + 1)] = text;
    return part;
}

bool gnuplot_is_there() { return run({"sh", "-c", "command -v gnuplot"}).status == 0; }

}  // namespace

BOOST_AUTO_TEST_CASE(pictures_with_their_scripts_and_data) {
    const Scratch folder;
    const Outcome outcome = hexagon(folder, {"--smoke", "--t-end", "2"});
    BOOST_TEST(outcome.status == 0);
    Words pictures{"plots/configurations", "plots/curves"};
    for (const char* label : {"md", "plain", "monaghan", "monaghan_torque_pair"})
        pictures.push_back(std::string(label) + "/plots/invariants");
    const bool gnuplot = gnuplot_is_there();
    BOOST_TEST(outcome.err.find("no pictures") == (gnuplot ? std::string::npos : 18u));
    for (const auto& picture : pictures) {
        const auto path = folder / ("rotating_hexagon-out/" + picture);
        BOOST_TEST(contents_of(path.string() + ".gp").find(".dat'") != std::string::npos);
        BOOST_TEST(contents_of(path.string() + ".dat").size() > 100u);
        if (!gnuplot) continue;
        const std::string png = contents_of(path.string() + ".png");
        BOOST_TEST(png.starts_with("\x89PNG\r\n\x1a\n"), picture);
        BOOST_TEST(png.size() > 5000u);
        BOOST_TEST(!std::filesystem::exists(path.string() + ".gp.err"));
    }
}

BOOST_AUTO_TEST_CASE(without_gnuplot_it_says_so_once) {
    const Scratch folder, programs;  // a machine with a shell and without gnuplot
    std::filesystem::create_symlink("/bin/sh", programs / "sh");
    Launch launch{folder.path()};
    launch.before_exec = [&] { setenv("PATH", programs.path().c_str(), 1); };
    const Outcome outcome = run(problem("rotating_hexagon", {"--smoke", "--t-end", "1"}), launch);
    BOOST_TEST(outcome.status == 0);
    BOOST_TEST(lines(outcome.err) == 1u);
    BOOST_TEST(outcome.err.find("gnuplot") != std::string::npos);
    BOOST_TEST(std::filesystem::exists(folder / "rotating_hexagon-out/plots/curves.gp"));
}

BOOST_AUTO_TEST_CASE(no_plots_leaves_none) {
    const Scratch folder;
    BOOST_TEST(hexagon(folder, {"--smoke", "--t-end", "1", "--no-plots"}).status == 0);
    for (const auto& [name, text] : folder.listing())
        BOOST_TEST(name.find("plots") == std::string::npos, name);
}

BOOST_AUTO_TEST_CASE(force_moves_old_results_aside) {
    const Scratch folder;
    BOOST_TEST(short_run(folder).status == 0);
    const auto first = below(folder, "rotating_hexagon-out");
    BOOST_TEST(first.contains("invariants.csv"));

    BOOST_TEST(short_run(folder).status == 2);
    BOOST_TEST((below(folder, "rotating_hexagon-out") == first));

    BOOST_TEST(short_run(folder, {"--force", "--speed", "0.2"}).status == 0);
    const auto second = below(folder, "rotating_hexagon-out");
    BOOST_TEST((below(folder, "rotating_hexagon-out.old-1") == first));
    BOOST_TEST((second != first));

    BOOST_TEST(short_run(folder, {"--force", "--out", "rotating_hexagon-out/"}).status == 0);
    BOOST_TEST((below(folder, "rotating_hexagon-out.old-1") == first));
    BOOST_TEST((below(folder, "rotating_hexagon-out.old-2") == second));
}

BOOST_AUTO_TEST_CASE(force_moves_only_results_aside) {
    const Scratch folder;
    folder.write("thesis/chapter_1.tex", "years of work");
    const auto before = folder.listing();
    const Outcome outcome = short_run(folder, {"--force", "--out", "thesis"});
    BOOST_TEST(outcome.status == 2);
    BOOST_TEST(lines(outcome.err) == 1u);
    BOOST_TEST((folder.listing() == before));
}

BOOST_AUTO_TEST_CASE(folders_of_any_name) {
    for (const std::string name :
         {"with space", "größe/λ", "a/b/c/d", "-dash", "quote'\"$(x)`", "50%"}) {
        const Scratch folder;
        const Outcome outcome = short_run(folder, {"--out=" + name});
        BOOST_TEST_CONTEXT(name << outcome.err) {
            BOOST_TEST(outcome.status == 0);
            BOOST_TEST(outcome.err == "");
            BOOST_TEST(std::filesystem::exists(folder / name / "result.json"));
            BOOST_TEST(std::filesystem::exists(folder / name / "plots" / "curves.png") ==
                       gnuplot_is_there());
        }
    }
}

BOOST_AUTO_TEST_CASE(an_empty_folder_and_a_link_to_one_are_used) {
    const Scratch folder;
    std::filesystem::create_directory(folder / "empty");
    std::filesystem::create_directory_symlink("empty", folder / "link");
    BOOST_TEST(short_run(folder, {"--out", "link"}).status == 0);
    BOOST_TEST(std::filesystem::exists(folder / "empty/result.json"));
    BOOST_TEST(std::filesystem::is_symlink(folder / "link"));
}

BOOST_AUTO_TEST_CASE(a_dry_run_tells_the_case_and_writes_nothing) {
    const Scratch folder;
    const Outcome outcome =
        hexagon(folder, {"--dry-run", "--size", "5", "--transport", "average", "--integrator",
                         "arkode:DORMAND_PRINCE_7_4_5", "--rtol", "1e-7", "--out", "nowhere"});
    BOOST_TEST(outcome.status == 0);
    BOOST_TEST(outcome.err == "");
    for (const char* words : {"91", "average", "DORMAND_PRINCE", "1e-07", "nowhere", "dry run"})
        BOOST_TEST(outcome.out.find(words) != std::string::npos, "no '" << words << "'");
    BOOST_TEST(folder.listing().empty());
}

BOOST_AUTO_TEST_CASE(a_dry_run_refuses_what_a_run_refuses) {
    const Scratch folder;
    BOOST_TEST(hexagon(folder, {"--dry-run", "--integrator", "arkode:NONE"}).status == 2);
    BOOST_TEST(hexagon(folder, {"--dry-run", "--density", "chain_rule"}).status == 2);
    BOOST_TEST(folder.listing().empty());
}

BOOST_AUTO_TEST_CASE(help_names_every_option) {
    const Scratch folder;
    const Outcome outcome = hexagon(folder, {"--help"});
    BOOST_TEST(outcome.status == 0);
    BOOST_TEST(outcome.err == "");
    for (const char* name : {"out",       "force",        "config",
                             "dry-run",   "smoke",        "quiet",
                             "no-plots",  "threads",      "ranks",
                             "t-end",     "output-every", "integrator",
                             "dt",        "rtol",         "atol",
                             "kernel",    "range",        "density",
                             "transport", "mean-density", "angular-momentum",
                             "size",      "speed",        "turns",
                             "model",     "controller",   "safety",
                             "min-step",  "max-step",     "initial-step",
                             "max-steps", "atol-stress"})
        BOOST_TEST(outcome.out.find(std::string("--") + name + " ") != std::string::npos, name);
    BOOST_TEST(folder.listing().empty());
}

BOOST_AUTO_TEST_CASE(quiet_prints_nothing) {
    const Scratch folder;
    const Outcome outcome = short_run(folder, {"--quiet"});
    BOOST_TEST(outcome.status == 0);
    BOOST_TEST(outcome.out == "");
    BOOST_TEST(outcome.err == "");
    BOOST_TEST(contents_of(folder / "rotating_hexagon-out/run.log").find("steps") !=
               std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_command_line_wins_over_a_case_read_back) {
    const Scratch folder;
    folder.write("case.toml",
                 "turns = 2.0\nsize = 2\nintegrator = \"arkode:DORMAND_PRINCE_7_4_5\"\n"
                 "rtol = 1e-6\natol = 1e-8\n");
    const auto run = [&](Words words) {
        words.insert(words.begin(), {"--config", "case.toml", "--no-plots", "--force"});
        return Child(problem("rotating_hexagon", words), {folder.path()})
            .finish(Child::Seconds(60));
    };
    const auto shorter = run({"--t-end", "3", "--model", "md"});
    BOOST_TEST(shorter.status == 0, shorter.err);
    const auto log = contents_of(folder / "rotating_hexagon-out/run.log");  // not wrapped
    BOOST_TEST((log.find("to t = 3\n") != std::string::npos), log);
    // Keys that every case of these problems holds, or that the other way of saying it has put there.
    const std::vector<std::tuple<std::string, std::string, Words>> others{
        {"plane_wave", "block = 3.0\ncells = 16\n", {"--polarization", "longitudinal"}},
        {"plane_wave", "block = 3.0\n", {"--compare-sizes"}},
        {"free_expansion", "cells = 8\n", {"--particles", "49"}},
        {"free_expansion", "particles = 49\n", {"--cells", "8"}},
        {"free_expansion", "compare = true\n", {"--cost"}},
        {"free_expansion", "cost = true\n", {"--compare"}}};
    for (const auto& [name, toml, words] : others) {
        folder.write("other.toml", toml);
        Words all{"--config", "other.toml", "--dry-run", "--smoke"};
        all.insert(all.end(), words.begin(), words.end());
        const auto other = Child(problem(name, all), {folder.path()}).finish(Child::Seconds(60));
        BOOST_TEST(other.status == 0, name << " " << words.front() << ": " << other.err);
    }
    const auto fixed = run({"--integrator", "rk4", "--turns", "0.01"});
    BOOST_TEST(fixed.status == 0, fixed.err);
    BOOST_TEST((fixed.out.find("rk4, fixed step dt = 0.1") != std::string::npos), fixed.out);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Free expansion as a user runs it: small gases against what is known of them, the files of fields and
// frames it leaves, and films, also where the program that makes them is missing or fails.
#include "problem/result_files.hpp"
#include "support/effort.hpp"

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace spam::test;
using Words = std::vector<std::string>;

namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

Outcome run_in(const Scratch& folder, Words arguments, std::function<void()> before = nullptr) {
    arguments.insert(arguments.end(), {"--out", "out"});
    return Child(problem("free_expansion", arguments), {folder.path(), 0, std::move(before)})
        .finish(Child::Seconds(240));
}

/// Results by name of a call that must succeed.
std::map<std::string, double> results_of(Words arguments) {
    const Scratch folder;
    arguments.push_back("--no-plots");
    const Outcome outcome = run_in(folder, arguments);
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    std::map<std::string, double> values;
    for (const auto& item : json_of(folder / "out/result.json"))
        values[item["name"]] = item["value"];
    return values;
}

/// A program of this name comes first on the path.
std::function<void()> with_program(const Scratch& folder, const std::string& script) {
    folder.write("bin/ffmpeg", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(folder / "bin/ffmpeg", std::filesystem::perms::all);
    const std::string path = (folder / "bin").string() + ":" + std::string(std::getenv("PATH"));
    return [path] { setenv("PATH", path.c_str(), 1); };
}

const Words film{"--smoke", "--t-end", "2", "--output-every", "0.5", "--movie"};

}  // namespace

/// Checks of its own: 100 particles end between .6 and .7, 1,000 on a line near .47.
BOOST_AUTO_TEST_CASE(small_gases_gain_the_entropy_they_should) {
    const auto hundred = results_of({"--particles", "100"});
    BOOST_TEST(std::abs(hundred.at("entropy_sum_plateau") - 0.65) < 0.05);
    if (long_runs()) {
        const auto line = results_of({"--dimension", "1", "--cells", "1000"});
        BOOST_TEST(std::abs(line.at("entropy_sum_plateau") - 0.47) < 0.02);
    }
    // Streaming is not entropy: before the gas meets the box there is none, and the wrong law has it.
    const auto early = results_of({"--cells", "40", "--t-end", "10"});
    BOOST_TEST(std::abs(early.at("entropy_sum")) < 0.03);
    BOOST_TEST(std::abs(early.at("entropy_grid")) < 0.03);
    BOOST_TEST(early.at("entropy_full_v2") > 0.3);
}

/// Smooth weights see single particles in the thin gas, and short runs end before the plateau does: numbers
/// all the same, and no claim that does not hold.
BOOST_AUTO_TEST_CASE(weights_and_ends_of_other_kinds) {
    for (const Words& options :
         {Words{"--kernel", "w8", "--cells", "24", "--t-end", "14"},
          Words{"--dimension", "1", "--smoke", "--kernel", "w6"},
          Words{"--particles", "100", "--smoke"}, Words{"--range", "3", "--smoke"}}) {
        const Scratch folder;
        Words all = options;
        all.emplace_back("--no-plots");
        const Outcome outcome = run_in(folder, all);
        BOOST_TEST(outcome.status == 0, outcome.out << outcome.err);
        BOOST_TEST(!contains(outcome.out, "BROKEN"), outcome.out);
        const Csv rows(folder / "out/invariants.csv");
        for (const auto& name : rows.names)
            for (const double value : rows.column(name)) BOOST_TEST(std::isfinite(value), name);
        for (const auto& item : json_of(folder / "out/result.json"))
            BOOST_TEST(item["value"].is_number(), item.dump());
    }
}

BOOST_AUTO_TEST_CASE(rows_snapshots_and_fields) {
    const Scratch folder;
    const Outcome outcome = run_in(folder, {"--smoke", "--no-plots", "--snapshot-every", "6"});
    BOOST_REQUIRE_MESSAGE(outcome.status == 0, outcome.out << outcome.err);
    const Csv rows(folder / "out/invariants.csv");
    for (const char* name : {"entropy_sum", "entropy_grid", "entropy_full_v2"})
        BOOST_TEST(rows.column(name).front() == 0.0);
    const std::string list = contents_of(folder / "out/fields.pvd");
    for (const char* name : {"fields_0000.vti", "fields_0004.vti"}) {
        BOOST_TEST(contains(list, name));
        BOOST_TEST(
            contains(contents_of(folder / ("out/" + std::string(name))), "velocity_fluctuation"));
    }
    BOOST_TEST(!contains(list, "fields_0005"));
    BOOST_TEST(contains(list, "timestep=\"24\""));
}

BOOST_AUTO_TEST_CASE(the_cost_is_a_table) {
    const Scratch folder;
    BOOST_TEST(run_in(folder, {"--smoke", "--no-plots", "--cost"}).status == 0);
    const Csv table(folder / "out/cost.csv");
    BOOST_TEST((table.column("particles") == std::vector<double>{100, 256}));
    for (const double s : table.column("seconds_per_unit_time")) BOOST_TEST(s > 0.0);
}

BOOST_AUTO_TEST_CASE(a_film_is_made_of_frames_of_one_size) {
    if (!have_gnuplot()) return;
    const Scratch folder;
    const auto ffmpeg = with_program(folder, "for last; do :; done; ls frame_*.png > \"$last\"");
    const Outcome outcome = run_in(folder, film, ffmpeg);
    BOOST_TEST(outcome.status == 0, outcome.err);
    BOOST_TEST(contains(outcome.out, "frames/expansion.mp4"));
    const auto frames = split(contents_of(folder / "out/frames/expansion.mp4"), '\n');
    BOOST_TEST(frames.size() == 5u);
    const auto size_of = [&](const std::string& name) {
        return contents_of(folder / ("out/frames/" + name)).substr(16, 8);
    };
    for (const auto& frame : frames) BOOST_TEST((size_of(frame) == size_of(frames.front())));
}

BOOST_AUTO_TEST_CASE(without_the_program_the_frames_are_left) {
    if (!have_gnuplot()) return;
    for (const bool missing : {true, false}) {
        const Scratch folder;
        auto path = with_program(folder, "exit 3");
        if (missing) {  // a path with a shell, gnuplot and nothing else
            std::filesystem::create_directories(folder / "few");
            for (const char* name : {"sh", "gnuplot"})
                for (const char* place : {"/bin/", "/usr/bin/", "/usr/local/bin/"})
                    if (std::filesystem::exists(std::string(place) + name)) {
                        std::filesystem::create_symlink(std::string(place) + name,
                                                        folder / ("few/" + std::string(name)));
                        break;
                    }
            path = [few = (folder / "few").string()] { setenv("PATH", few.c_str(), 1); };
        }
        const Outcome outcome = run_in(folder, film, path);
        BOOST_TEST(outcome.status == 0, outcome.err);
        BOOST_TEST(contains(outcome.out, missing ? "ffmpeg is not installed" : "ffmpeg failed"));
        BOOST_TEST(std::filesystem::exists(folder / "out/frames/frame_0004.png"));
        BOOST_TEST(!std::filesystem::exists(folder / "out/frames/expansion.mp4"));
    }
}

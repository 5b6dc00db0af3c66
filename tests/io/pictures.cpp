// SPDX-License-Identifier: GPL-3.0-or-later
// Every kind of picture: gnuplot takes the script without a word and leaves a PNG of the size asked
// for, whatever the values and titles are.
#include "support/process.hpp"
#include <spam/core/error.hpp>
#include <spam/picture/draw.hpp>

#include <boost/test/unit_test.hpp>
#include <sys/resource.h>

#include <cmath>

using namespace spam;
using spam::test::contents_of;
using spam::test::have_gnuplot;
using spam::test::Scratch;

namespace {

const double missing = std::nan("");
const std::string awkward = "a_b^c {d} \"e\" 'f' \\ @ & ~ ⟨v⟩ %g $x `touch ran` \n two";

std::size_t big_endian(const std::string& bytes, std::size_t at) {
    std::size_t number = 0;
    for (std::size_t k = 0; k < 4; ++k)
        number = number * 256 + static_cast<unsigned char>(bytes[at + k]);
    return number;
}

/// A picture at least this large, and nothing else left behind.
void check_picture(const Scratch& folder, bool drawn, std::size_t width, std::size_t height) {
    BOOST_TEST(std::filesystem::exists(folder / "plots/picture.gp"));
    BOOST_TEST(std::filesystem::exists(folder / "plots/picture.dat"));
    BOOST_TEST(drawn == have_gnuplot());
    if (!have_gnuplot()) return;
    BOOST_TEST(!std::filesystem::exists(folder / "plots/picture.gp.err"));
    const std::string png = contents_of(folder / "plots/picture.png");
    BOOST_REQUIRE(png.starts_with("\x89PNG\r\n\x1a\n"));
    BOOST_TEST(big_endian(png, 16) >= width);
    BOOST_TEST(big_endian(png, 20) >= height);
    BOOST_TEST(png.size() > 2000u);
}

RunFolder plots(const Scratch& folder) { return {folder / "plots", false}; }

BarChart chart(bool log) {
    return {
        "turns survived", log, {{"plain v", 0.4}, {awkward, 100.0, "> 100", 3}, {"x", missing}}};
}

HeatMap table(std::size_t values, bool log) {
    HeatMap map{{{"core", {"no", "yes"}}, {"density", {"summed", "continuity"}}},
                {{"transport", {"v", "⟨v⟩", awkward}}},
                {},
                {},
                "turns",
                log};
    for (std::size_t k = 0; k < values; ++k) map.value.push_back(static_cast<double>(k) - 1.0);
    return map;
}

}  // namespace

BOOST_AUTO_TEST_CASE(curves_and_points) {
    const Scratch folder;
    const CurvePanel panel{awkward,
                           "r",
                           "stress",
                           false,
                           {{"measured", {0, 1, 2}, {1, missing, 3}, Mark::points, 2},
                            {"analytic", {0, 2}, {1, 3}, Mark::line, 2},
                            {"empty", {}, {}}}};
    CurvePanel log = panel;
    log.log_y = true;
    check_picture(folder, draw_curves(plots(folder), "picture", awkward, {panel, log}), 1240, 540);
}

BOOST_AUTO_TEST_CASE(frames_with_curves_of_their_own) {
    const Scratch folder;
    const CurvePanel one{"one", "x", "y", false, {{"a", {0, 1}, {1, 1}}}};
    const CurvePanel two{"two", "x", "y", true, {{"b", {0, 1}, {0, -5}, Mark::points}}};
    check_picture(folder, draw_curves(plots(folder), "picture", "t", {one, two}), 1240, 540);
}

BOOST_AUTO_TEST_CASE(configurations) {
    const Scratch folder;
    Points<2> square(2, 4);
    square << -1, 1, 1, -1, -1, -1, 1, 1;
    const ConfigurationPanel panel{awkward, square, {0, 1, 2, 3}, {square}};
    const ConfigurationPanel still{"all alike", square, {0, 0, 0, 0}, {}};
    const bool drawn =
        draw_configurations(plots(folder), "picture", awkward, {panel, still, panel}, 2, "speed");
    check_picture(folder, drawn, 680, 680);
}

BOOST_AUTO_TEST_CASE(paths) {
    Points<2> square(2, 4), line(2, 3);
    square << -1, 1, 1, -1, -1, -1, 1, 1;
    line << 0, 0.5, missing, 0, 3.0, 1;
    const PathPanel framed{awkward, {line, square}, square};
    const PathPanel nothing{"nothing moved", {}, {}};
    for (const auto& panels : {std::vector{framed, nothing, framed}, std::vector{nothing}}) {
        const Scratch folder;
        check_picture(folder, draw_paths(plots(folder), "picture", awkward, panels, 2), 470, 470);
    }
}

BOOST_AUTO_TEST_CASE(bars) {
    for (const bool log : {false, true}) {
        const Scratch folder;
        check_picture(folder, draw_bars(plots(folder), "picture", awkward, chart(log)), 700, 200);
    }
}

BOOST_AUTO_TEST_CASE(bars_below_zero_and_none_at_all) {
    const Scratch folder;
    const BarChart negative{"change", false, {{"a", -3.0}, {"b", 2.0}}};
    check_picture(folder, draw_bars(plots(folder), "picture", "t", negative), 700, 150);
    const Scratch other;
    const BarChart nothing{"change", true, {{"a", 0.0}, {"b", missing}}};
    check_picture(other, draw_bars(plots(other), "picture", "t", nothing), 700, 150);
}

BOOST_AUTO_TEST_CASE(heat_maps) {
    for (const bool log : {false, true}) {
        const Scratch folder;
        HeatMap map = table(12, log);
        map.value[5] = missing;
        if (log) map.text.assign(12, awkward);
        check_picture(folder, draw_heat_map(plots(folder), "picture", awkward, map), 276, 176);
    }
    const Scratch folder;
    HeatMap map = table(12, false);
    map.value.assign(12, missing);
    check_picture(folder, draw_heat_map(plots(folder), "picture", "nothing known", map), 276, 176);
}

BOOST_AUTO_TEST_CASE(logarithmic_axes) {
    const LogLogPanel panel{awkward,
                            "calls",
                            "error",
                            {{0, false, {10, 100, 1000}, {1e-2, missing, 1e-9}},
                             {1, true, {10, 20, -1}, {1e-3, 0.0, 1e-4}},
                             {7, false, {}, {}}},
                            1e-13,
                            awkward};
    const LogLogPanel one{"one point", "t", "drift", {{0, false, {3}, {4}}}};
    const LogLogPanel none{"none", "t", "drift", {}};
    for (const bool marks : {true, false}) {
        const Scratch folder;
        LogLogPicture picture{awkward, {panel, one, none}, 2, {"rk4", awkward}, awkward, marks};
        for (int k = 0; k < 9; ++k) picture.key.push_back("method");
        check_picture(folder, draw_log_log(plots(folder), "picture", picture), 1200, 900);
    }
}

BOOST_AUTO_TEST_CASE(contours) {
    const auto grid = FieldGrid<2>::over(Box<2>({8.0, 4.0}), {16, 8});
    const Points<2> at = grid.points();
    ContourPanel tones{.title = awkward, .side = awkward, .grid = grid};
    for (const auto& r : at.colwise()) tones.values.push_back(std::sin(r.x()) + r.y() - 2.0);
    ContourPanel colours = tones, flat = tones, dots{.title = "", .side = "", .particles = at};
    colours.colours = ContourPanel::Colours{-1.0, 2.0, awkward};
    colours.periodic = false;
    flat.values.assign(grid.size(), 1.0);
    const ContourPanel none{.title = "no particles"};
    const Scratch folder;
    const std::vector<ContourPanel> panels{tones, colours, dots, flat, none};
    const ContourRoom room{{0.0, 0.0}, {8.0, 4.0}};
    check_picture(folder, draw_contours(plots(folder), "picture", awkward, panels, 2, room), 640,
                  540);
    // Frames of a film are alike, and their sides even.
    const Scratch film;
    const RunFolder frames = plots(film);
    draw_contours(frames, "picture", "t", {dots}, 1, room);
    ContourPanel later = dots;
    later.particles = Points<2>(2, 0);
    draw_contours(frames, "next", "t", {later}, 1, room);
    if (!have_gnuplot()) return;
    const auto head = [&](const char* name) {
        return contents_of(film / ("plots/" + std::string(name) + ".png")).substr(16, 8);
    };
    BOOST_TEST(head("picture") == head("next"));
    BOOST_TEST(static_cast<unsigned char>(head("next")[3]) % 2 == 0);
    BOOST_TEST(static_cast<unsigned char>(head("next")[7]) % 2 == 0);
}

/// What the other tests rely on: a script that is wrong (its file name ends a string) is noticed.
BOOST_AUTO_TEST_CASE(a_wrong_script_is_no_picture) {
    const Scratch folder;
    const BarChart bars{"turns", false, {{"a", HUGE_VAL}, {"b", 1.0}}};
    BOOST_TEST(draw_bars(plots(folder), "good", "t", bars) == have_gnuplot());
    BOOST_TEST(!draw_bars(RunFolder(folder / "wrong", false), "it's", "t", bars));
    BOOST_TEST(std::filesystem::file_size(folder / "wrong/it's.gp.err") > 0u);
}

/// No file may grow beyond some blocks: what a full disk looks like, and gnuplot does not look at that. A link
/// of the picture's name is no way out of the folder.
BOOST_AUTO_TEST_CASE(half_a_picture_is_none) {
    if (!have_gnuplot()) return;
    const Scratch folder;
    folder.write("precious", "not yours");
    const RunFolder into = plots(folder);
    std::filesystem::create_symlink("../precious", folder / "plots/picture.png");
    std::filesystem::create_symlink("../precious", folder / "plots/picture.gp.err");
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit few{4096, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // as in every run
    setrlimit(RLIMIT_FSIZE, &few);
    std::string said;
    try {
        draw_bars(into, "picture", "t", chart(false));
    } catch (const OutputError& error) {
        said = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    BOOST_TEST(said.find("picture.png") != std::string::npos, said);
    BOOST_TEST(!std::filesystem::exists(folder / "plots/picture.png"));
    check_picture(folder, draw_bars(into, "picture", "t", chart(false)), 400, 200);
    BOOST_TEST(contents_of(folder / "precious") == "not yours");
}

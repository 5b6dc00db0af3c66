// SPDX-License-Identifier: GPL-3.0-or-later
// Sides of a box as options say them.
#include "support/refusal.hpp"
#include <spam/problem/sides.hpp>

#include <boost/test/unit_test.hpp>

using namespace spam;
using spam::test::refusal;
using Words = std::vector<std::string>;

namespace {

/// The box of these options between (0, 0) and (4, 3), else periodic along x, between mirrors along y.
Box<2> box_of(const Words& words) {
    Options options("test", "a test");
    const Sides sides(options, {"periodic", "periodic", "mirror", "mirror"});
    std::vector<const char*> arguments{"test"};
    for (const auto& word : words) arguments.push_back(word.c_str());
    options.parse(static_cast<int>(arguments.size()), arguments.data());
    return sides.box<2>(Point<2>::Zero(), Point<2>(4.0, 3.0));
}

bool refused(const Words& words, const std::string& what) {
    const std::string line = refusal([&] { box_of(words); });
    return line.find(what) != std::string::npos && line.find('\n') == std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(words_make_walls) {
    const Box<2> box = box_of({"--top", "moving:-0.25@1.5", "--bottom", "no-slip"});
    BOOST_TEST(box.periodic(0));
    BOOST_TEST(box.length(0) == 4.0);
    BOOST_TEST((box.wall(1, false).kind == WallKind::no_slip));
    BOOST_TEST(!box.wall(1, false).temperature);
    BOOST_TEST(box.wall(1, true).at == 3.0);
    BOOST_TEST(box.wall(1, true).velocity == Point<2>(-0.25, 0.0));
    BOOST_TEST(*box.wall(1, true).temperature == 1.5);
}

BOOST_AUTO_TEST_CASE(sides_move_along_themselves) {
    const Box<2> box = box_of({"--left", "moving:0.5", "--right", "open", "--top", "open"});
    BOOST_TEST(!box.periodic(0));
    BOOST_TEST(box.wall(0, false).velocity == Point<2>(0.0, 0.5));
    BOOST_TEST(box.wall(0, true).open());
    BOOST_TEST(box.wall(1, true).open());
    BOOST_TEST((box.wall(1, false).kind == WallKind::mirror));
    BOOST_TEST((box_of({"--bottom", "rigid"}).wall(1, false).kind == WallKind::rigid));
}

BOOST_AUTO_TEST_CASE(in_space_they_have_two_velocities) {
    const auto walls = [](const char* top) {
        Options options("test", "a test");
        const Sides sides(options, {"open", "open", "open", "mirror", "open", "open"});
        const std::array<const char*, 3> arguments{"test", "--top", top};
        options.parse(3, arguments.data());
        return sides.box<3>(Point<3>::Zero(), Point<3>::Ones()).wall(1, true).velocity;
    };
    BOOST_TEST(walls("moving:0.5") == Point<3>(0.5, 0.0, 0.0));
    BOOST_TEST(walls("moving:0.5,-0.25") == Point<3>(0.5, 0.0, -0.25));
    const auto why = [&](const char* top) { return refusal([&] { walls(top); }); };
    BOOST_TEST(why("moving:0.5,-0.25,1").find("moves along itself") != std::string::npos);
    BOOST_TEST(why("moving:0.5,").find("has '' for a velocity") != std::string::npos);
    BOOST_TEST(refused({"--top", "moving:0.5,1"}, "has '0.5,1' for a velocity"));
}

/// A word of the problem's own, for what other options say.
BOOST_AUTO_TEST_CASE(words_may_stand_for_others) {
    Options options("test", "a test");
    const Sides sides(options, {"", "", "no-slip", "moving"},
                      {.own = "moving", .stands_for = "V is --speed"});
    const char* const program = "test";
    options.parse(1, &program);
    const Sides::Meanings meanings{{"moving", "moving:0.5"}};
    const Box<2> box = sides.box<2>(Point<2>::Zero(), Point<2>(4.0, 3.0), meanings);
    BOOST_TEST(box.wall(0, false).open());
    BOOST_TEST(box.wall(1, true).velocity.x() == 0.5);
    BOOST_TEST((sides.names() == Words{"bottom", "top"}));
    BOOST_TEST(refusal([&] {
                   sides.box<2>(Point<2>::Zero(), Point<2>(4.0, 3.0));
               }).find("top: 'moving' is none of") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(words_of_a_problem_may_have_a_temperature) {
    Options options("test", "a test");
    const Sides lid(options, {"", "", "no-slip", "moving@2"}, {.own = "moving", .stands_for = ""});
    const Box<2> box =
        lid.box<2>(Point<2>::Zero(), Point<2>(4.0, 3.0), {{"moving", "moving:+0.5"}});
    BOOST_TEST(box.wall(1, true).velocity.x() == 0.5);
    BOOST_TEST(*box.wall(1, true).temperature == 2.0);
}

/// What a problem excludes is refused with its reason, and --help does not offer it.
BOOST_AUTO_TEST_CASE(problems_exclude_kinds_of_sides) {
    const SideOption closed(
        "mirror", {{SideKind::open, "would let the gas out"}, {SideKind::periodic, "has no end"}});
    Options options("test", "a test");
    const Sides sides(options, {closed, closed}, {.temperatures = false});
    const char* const words[]{"test", "--left", "open", "--right", "mirror@1"};
    options.parse(5, words);
    const auto box = [&] { sides.box<1>(Point<1>(0.0), Point<1>(1.0)); };
    BOOST_TEST(refusal(box) == "left: 'open' would let the gas out; use mirror, no-slip or rigid");
    Options others("test", "a test");
    const Sides warm(others, {closed, closed}, {.temperatures = false});
    const char* const temperature[]{"test", "--right", "mirror@1"};
    others.parse(3, temperature);
    BOOST_TEST(refusal([&] {
                   warm.box<1>(Point<1>(0.0), Point<1>(1.0));
               }).starts_with("right: 'mirror@1' has a temperature, and nothing"));
}

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    BOOST_TEST(refused({"--left", "mirror"}, "right: 'periodic' but --left is not"));
    BOOST_TEST(refused({"--right", "open"}, "but --right is not"));
    BOOST_TEST(refused({"--top", "wall"}, "top: 'wall' is none of open, periodic, mirror"));
    BOOST_TEST(refused({"--top", "mirror@"}, "has '' for a temperature"));
    BOOST_TEST(refused({"--top", "mirror@0"}, "give a number between 1e-06 and 1e+06"));
    BOOST_TEST(refused({"--top", "no-slip@-1"}, "has '-1' for a temperature"));
    BOOST_TEST(refused({"--top", "no-slip@1e300"}, "has '1e300' for a temperature"));
    BOOST_TEST(refused({"--top", "moving:1e300"}, "give a number between -5 and 5"));
    BOOST_TEST(refused({"--top", "moving:+-1"}, "has '+-1' for a velocity"));
    BOOST_TEST(refused({"--top", "no-slip@inf"}, "has 'inf' for a temperature"));
    BOOST_TEST(refused({"--top", "open@1"}, "is no wall"));
    BOOST_TEST(refused({"--top", "rigid@1"}, "nothing behind it that could be warm"));
    BOOST_TEST(refused({"--left", "periodic@1"}, "is no wall"));
    BOOST_TEST(refused({"--bottom", "moving:fast"}, "has 'fast' for a velocity"));
    BOOST_TEST(refused({"--bottom", "moving"}, "is none of"));
    Options options("test", "a test");
    const Sides line(options, {"moving:1", "open"});
    BOOST_TEST(refusal([&] { line.box<1>(Point<1>(0.0), Point<1>(1.0)); }).find("on a line") !=
               std::string::npos);
}

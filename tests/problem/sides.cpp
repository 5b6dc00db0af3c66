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

/// A word of the problem's own, for what other options say.
BOOST_AUTO_TEST_CASE(words_may_stand_for_others) {
    Options options("test", "a test");
    const Sides sides(options, {"", "", "no-slip", "moving"}, ", moving (with --speed)");
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

BOOST_AUTO_TEST_CASE(what_makes_no_sense) {
    BOOST_TEST(refused({"--left", "mirror"}, "right: 'periodic' but --left is not"));
    BOOST_TEST(refused({"--right", "open"}, "but --right is not"));
    BOOST_TEST(refused({"--top", "wall"}, "top: 'wall' is none of open, periodic, mirror"));
    BOOST_TEST(refused({"--top", "mirror@"}, "has '' for a temperature"));
    BOOST_TEST(refused({"--top", "mirror@0"}, "not above 0"));
    BOOST_TEST(refused({"--top", "no-slip@-1"}, "not above 0"));
    BOOST_TEST(refused({"--top", "no-slip@inf"}, "has 'inf' for a temperature"));
    BOOST_TEST(refused({"--top", "open@1"}, "is no wall"));
    BOOST_TEST(refused({"--top", "rigid@1"}, "nothing behind it that could be warm"));
    BOOST_TEST(refused({"--left", "periodic@1"}, "is no wall"));
    BOOST_TEST(refused({"--bottom", "moving:fast"}, "has 'fast' for a velocity"));
    BOOST_TEST(refused({"--bottom", "moving"}, "is none of"));
    Options options("test", "a test");
    const Sides line(options, {"moving:1", "open"});
    BOOST_TEST(refusal([&] { line.box<1>(Point<1>(0.0), Point<1>(1.0)); }).find("is none of") !=
               std::string::npos);
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Laws and schemes in boxes: every kind of wall with every law is accounted for or refused, and fluids that are
// shifted keep what they promise. No kind of wall is forgotten: the header is looked at.
#include "rhs/walled.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace spam;
using namespace spam::test;

BOOST_AUTO_TEST_CASE(no_kind_of_wall_is_left_out) {
    std::ifstream in(std::filesystem::path(SPAM_SOURCE) / "include/spam/neighbors/wall.hpp");
    std::stringstream text;
    text << in.rdbuf();
    const std::string source = text.str(), begin = "enum class WallKind {";
    const auto from = source.find(begin) + begin.size();
    const std::string kinds = source.substr(from, source.find('}', from) - from);
    const std::regex name("\\n\\s+(\\w+),");
    int found = 0;
    for (std::sregex_iterator it(kinds.begin(), kinds.end(), name), end; it != end; ++it, ++found)
        BOOST_TEST(((*it)[1] == "open" || walls.contains((*it)[1])), (*it)[1]);
    BOOST_TEST(found >= 3);
}

BOOST_AUTO_TEST_CASE(every_kind_of_wall_with_every_law_is_accounted_for_or_refused) {
    int ran = 0, refused = 0;
    const auto count = [&](const Row& row) {
        judge(row);
        ++(row.refused.empty() ? ran : refused);
    };
    const auto gravity = externals.at("Gravity"), nothing = externals.at("");
    for (const auto& [kind, wall] : walls) {
        const Box<2> box = walled_by(wall);
        for (const auto& law : with_scheme)
            for_each_scheme([&, name = kind](const Scheme& scheme) {
                BOOST_TEST_CONTEXT(name << ": " << law.first << ", " << scheme.describe())
                count(combine(law.second, further.at(""), scheme, gravity, box));
            });
        for (const auto* laws : {&with_scheme, &without_scheme})
            for (const auto& [law, build] : *laws)
                for (const auto& [more, add] : further)
                    BOOST_TEST_CONTEXT(kind << ": " << law << " + " << more)
        count(combine(build, add, Scheme{}, nothing, box));
    }
    BOOST_TEST_MESSAGE(ran << " combinations with walls run, " << refused << " are refused");
    BOOST_TEST(ran > 200);
    BOOST_TEST(refused > 200);
}

/// Shifting is refused above, in open space. Here fluids fill a periodic box.
BOOST_AUTO_TEST_CASE(shifted_fluids_with_every_external) {
    Fluid rubbing{EmbeddedAtom{1.0, site_density}, NewtonViscosity{0.1, 0.3}};
    const Fluid smooth = rubbing, cold{rubbing.state};
    rubbing.by_pairs = true;
    const Box<2> box = triangular_box(8, 6);
    int ran = 0, refused = 0;
    for (const Fluid& fluid : {cold, smooth, rubbing})
        for (const auto& external : externals)
            for_each_scheme([&](const Scheme& scheme) {
                if (scheme.transport != Transport::shifting) return;
                BOOST_TEST_CONTEXT(fluid.describe()
                                   << " + " << external.first << ", " << scheme.describe()) {
                    const Build full = [&](Sample& s, const Scheme& given) {
                        add_fluid(s, fluid, given);
                    };
                    const Row row = combine(full, further.at(""), scheme, external.second, box);
                    judge(row);
                    BOOST_TEST(!row.turns);
                    ++(row.refused.empty() ? ran : refused);
                }
            });
    // Continuity or summed, with artificial viscosity where friction is not by pairs.
    const int all = static_cast<int>(externals.size());
    BOOST_TEST(ran == all * 2 * (2 + 2 + 1));
    BOOST_TEST(refused == all * 3 * 3 * 4 * 2 * 2 - ran);
}

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
        BOOST_TEST(((*it)[1] == "open" || walls<2>.contains((*it)[1])), (*it)[1]);
    BOOST_TEST(found >= 3);
}

namespace {

template <int Dim>
Tally every_wall() {
    Tally tally;
    const auto gravity = externals<Dim>().at("Gravity"), nothing = externals<Dim>().at("");
    for (const auto& [kind, wall] : walls<Dim>) {
        const Box<Dim> box = walled_by(wall);
        for (const auto& law : with_scheme<Dim>())
            for_each_scheme([&, name = kind](const Scheme& scheme) {
                tally.count(name + ": " + law.first + ", " + scheme.describe(),
                            combine<Dim>(law.second, further<Dim>().at(""), scheme, gravity, box));
            });
        for (const auto& [law, build] : all_laws<Dim>())
            for (const auto& [more, add] : further<Dim>())
                tally.count(kind + ": " + law + " + " + more,
                            combine<Dim>(build, add, Scheme{}, nothing, box));
    }
    return tally;
}

/// Shifting is refused there, in open space. Here fluids fill a periodic box.
template <int Dim>
Tally every_shifted_fluid() {
    const EmbeddedAtom cold{1.0, site_density<Dim>};
    const NewtonViscosity friction{0.1, 0.3};
    const std::map<std::string, Fluid> fluids{
        {"cold", {cold}}, {"rubbing", {cold, friction}}, {"by pairs", {cold, friction, {}, true}}};
    Tally tally;
    for (const auto& fluid : fluids)
        for (const auto& external : externals<Dim>())
            for_each_scheme([&](const Scheme& scheme) {
                if (scheme.transport != Transport::shifting) return;
                const Build<Dim> full = [&](Sample<Dim>& s, const Scheme& given) {
                    add_fluid(s, fluid.second, given);
                };
                tally.count(fluid.first + " + " + external.first + ", " + scheme.describe(),
                            combine<Dim>(full, further<Dim>().at(""), scheme, external.second,
                                         full_box<Dim>()));
            });
    // Continuity or summed, with artificial viscosity and without.
    const std::size_t all = externals<Dim>().size();
    BOOST_TEST(tally.losing == tally.ran);
    BOOST_TEST(tally.ran == all * fluids.size() * 2 * 2);
    BOOST_TEST(tally.fate.size() == all * 3 * 3 * 4 * 2 * 2);
    return tally;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_kind_of_wall_with_every_law_is_accounted_for_or_refused) {
    const Tally plane = every_wall<2>();
    compare(plane, every_wall<3>());
    BOOST_TEST(plane.ran > 200u);
    BOOST_TEST(plane.refused() > 200u);
}

BOOST_AUTO_TEST_CASE(shifted_fluids_with_every_external) {
    compare(every_shifted_fluid<2>(), every_shifted_fluid<3>());
}

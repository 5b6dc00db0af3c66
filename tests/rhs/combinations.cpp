// SPDX-License-Identifier: GPL-3.0-or-later
// Every law of matter x every further term x every choice of scheme, with and without externals: each
// combination keeps what it promises, or is refused with a reason. No term and no external is forgotten: the
// headers are looked at.
#include "rhs/combinations.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace spam;
using namespace spam::test;

namespace {

std::set<std::string> classes_derived_from(const std::string& base, const std::string& room) {
    std::set<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SPAM_SOURCE) / room)) {
        std::ifstream in(entry.path());
        std::stringstream text;
        text << in.rdbuf();
        const std::string source = text.str();
        const std::regex derived("class (\\w+) (?:final )?: public " + base + "<(?:Dim|2)>");
        for (std::sregex_iterator it(source.begin(), source.end(), derived), end; it != end; ++it)
            names.insert((*it)[1]);
    }
    return names;
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_term_and_no_external_is_left_out) {
    std::set<std::string> terms, outside;
    for (const auto* laws : {&with_scheme, &without_scheme})
        for (const auto& [name, build] : *laws) terms.insert(name.substr(0, name.find(',')));
    for (const auto& [name, build] : further) terms.insert(name);
    for (const auto& [name, add] : externals) outside.insert(name);
    auto all_terms = classes_derived_from("Term", "include/spam/rhs");
    all_terms.merge(classes_derived_from("PairTerm", "include/spam/rhs"));
    all_terms.erase("PairTerm");  // what they have in common
    const auto all_externals = classes_derived_from("External", "include/spam/external");
    BOOST_TEST(all_terms.size() >= 7u);
    BOOST_TEST(all_externals.size() >= 6u);
    for (const auto& name : all_terms) BOOST_TEST(terms.contains(name), name);
    for (const auto& name : all_externals)
        BOOST_TEST((outside.contains(name) || name == "RigidVelocity"), name);
}

BOOST_AUTO_TEST_CASE(every_scheme_with_every_further_term_keeps_its_promises_or_is_refused) {
    const std::function<void(Sample&)> all_at_once = [](Sample& s) {
        for (const char* name : {"Gravity", "Friction", "Drag"}) externals.at(name)(s);
    };
    int ran = 0, refused = 0, not_turning = 0;
    for (const auto& law : with_scheme)
        for (const auto& more : further)
            for_each_scheme([&](const Scheme& scheme) {
                for (const bool outside : {false, true})
                    BOOST_TEST_CONTEXT(law.first << " + " << more.first << ", " << scheme.describe()
                                                 << (outside ? ", externals" : "")) {
                        const Row row = combine(law.second, more.second, scheme,
                                                outside ? all_at_once : externals.at(""));
                        judge(row);
                        ++(row.refused.empty() ? ran : refused);
                        not_turning += row.refused.empty() && !row.turns;
                    }
            });
    BOOST_TEST_MESSAGE(ran << " combinations run, " << not_turning
                           << " of them without a promise for L; " << refused << " are refused");
    BOOST_TEST(ran > 700);
    BOOST_TEST(refused > 700);
}

BOOST_AUTO_TEST_CASE(every_law_with_every_further_term_and_every_external) {
    int ran = 0;
    for (const auto* laws : {&with_scheme, &without_scheme})
        for (const auto& [law, build] : *laws)
            for (const auto& [more, add] : further)
                for (const auto& [external, act] : externals)
                    BOOST_TEST_CONTEXT(law << " + " << more << ", " << external) {
                        const Row row = combine(build, add, Scheme{}, act);
                        judge(row);
                        BOOST_TEST(row.refused.empty(), row.refused);
                        ++ran;
                    }
    BOOST_TEST(ran == 15 * 8 * 9);
}

/// What the text forbids, by name.
BOOST_AUTO_TEST_CASE(potentials_of_positions_need_plain_velocities) {
    const Scheme averaged{.transport = Transport::monaghan};
    for (const auto& [more, add] : further) {
        if (more.empty() || more == "ArtificialViscosity" || more == "ReflectedPairs") continue;
        const Row row =
            combine(with_scheme.at("SmoothParticles, solid"), add, averaged, externals.at(""));
        BOOST_TEST(row.refused.find("averaged velocity") != std::string::npos, more);
    }
    const Scheme summed{.density = Density::summed, .transport = Transport::monaghan};
    const Row row =
        combine(with_scheme.at("SmoothParticles, gas"), further.at(""), summed, externals.at(""));
    BOOST_TEST(row.refused.find("gains energy without limit") != std::string::npos);
}

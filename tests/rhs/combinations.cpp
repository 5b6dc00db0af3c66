// SPDX-License-Identifier: GPL-3.0-or-later
// Every law of matter x every further term x every choice of scheme, with and without externals: each
// combination keeps what it promises, or is refused with a reason. No term and no external is forgotten: the
// headers are looked at.
#include "rhs/every_combination.hpp"
#include "rhs/more_laws.hpp"

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

// In combinations_in_space.cpp, because it takes long to compile.
extern template Tally spam::test::every_scheme<3>();
extern template Tally spam::test::every_external<3>();
extern template void spam::test::potentials_need_plain_velocities<3>();

BOOST_AUTO_TEST_CASE(no_term_and_no_external_is_left_out) {
    std::set<std::string> terms, outside;
    for (const auto& [name, build] : all_laws<2>()) terms.insert(name.substr(0, name.find(',')));
    for (const auto& [name, build] : further<2>()) terms.insert(name);
    for (const auto& [name, build] : more_laws<2>())  // in units.cpp and parts.cpp
        terms.insert(name.substr(0, name.find(' ')));
    for (const auto& [name, add] : externals<2>()) outside.insert(name);
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
    const Tally plane = every_scheme<2>();
    compare(plane, every_scheme<3>());
    BOOST_TEST(plane.ran > 700u);
    BOOST_TEST(plane.refused() > 700u);
}

BOOST_AUTO_TEST_CASE(every_law_with_every_further_term_and_every_external) {
    const Tally plane = every_external<2>(), space = every_external<3>();
    compare(plane, space);
    BOOST_TEST(plane.ran == 16u * 8u * 9u);
    BOOST_TEST(space.ran == 15u * 8u * 9u);
}

BOOST_AUTO_TEST_CASE(potentials_of_positions_need_plain_velocities) {
    potentials_need_plain_velocities<2>();
    potentials_need_plain_velocities<3>();
}

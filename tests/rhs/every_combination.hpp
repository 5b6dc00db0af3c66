// SPDX-License-Identifier: GPL-3.0-or-later
// All laws with all further terms, by the choices of scheme and by the externals.
#pragma once

#include "rhs/combinations.hpp"

namespace spam::test {

template <int Dim>
Tally every_scheme() {
    const Add<Dim> all_at_once = [](Sample<Dim>& s) {
        for (const char* name : {"Gravity", "Friction", "Drag"}) externals<Dim>().at(name)(s);
    };
    Tally tally;
    for (const auto& law : with_scheme<Dim>())
        for (const auto& more : further<Dim>())
            for_each_scheme([&](const Scheme& scheme) {
                for (const bool outside : {false, true})
                    tally.count(law.first + " + " + more.first + ", " + scheme.describe() +
                                    (outside ? ", externals" : ""),
                                combine<Dim>(law.second, more.second, scheme,
                                             outside ? all_at_once : externals<Dim>().at("")));
            });
    return tally;
}

template <int Dim>
Tally every_external() {
    Tally tally;
    for (const auto& [law, build] : all_laws<Dim>())
        for (const auto& [more, add] : further<Dim>())
            for (const auto& [external, act] : externals<Dim>())
                tally.count(law + " + " + more + ", " + external,
                            combine<Dim>(build, add, Scheme{}, act));
    return tally;
}

/// What the text forbids, by name.
template <int Dim>
void potentials_need_plain_velocities() {
    const auto refused = [](const char* law, const Add<Dim>& add, const Scheme& scheme) {
        return combine<Dim>(with_scheme<Dim>().at(law), add, scheme, externals<Dim>().at(""))
            .refused;
    };
    for (const auto& [more, add] : further<Dim>()) {
        if (more.empty() || more == "ArtificialViscosity" || more == "ReflectedPairs") continue;
        BOOST_TEST(refused("SmoothParticles, solid", add, {.transport = Transport::monaghan})
                           .find("averaged velocity") != std::string::npos,
                   more);
    }
    BOOST_TEST(refused("SmoothParticles, gas", further<Dim>().at(""),
                       {.density = Density::summed, .transport = Transport::monaghan})
                   .find("gains energy without limit") != std::string::npos);
}

}  // namespace spam::test

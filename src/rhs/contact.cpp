// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_sweeps.hpp"
#include "term_sweeps.hpp"
#include <spam/core/error.hpp>
#include <spam/rhs/contact.hpp>

#include <fmt/format.h>

#include <cmath>

namespace spam {
namespace {

template <int Dim>
PairLaw<Dim> law_of(const Particles<Dim>& particles, const CorePotential& core) {
    const auto positive = [](const char* option, double value) {
        if (!(value > 0.0) || !std::isfinite(value))
            throw InputError(
                fmt::format("{}: {:g} must be above 0, or bodies would pass through each other",
                            option, value));
    };
    positive("contact", core.e_c);
    positive("contact-range", core.s);
    PairLaw<Dim> law{best_sweeps([](auto level) { return contact_sweeps<Dim, level>(); }), core.s,
                     fmt::format("contact of bodies, core {:g} of range {:g}", core.e_c, core.s)};
    law.constants.core_energy = core.e_c;
    law.constants.core_range = core.s;
    law.columns.emplace_back(particles.body.begin(), particles.body.end());
    return law;
}

}  // namespace

template <int Dim>
Contact<Dim>::Contact(const Selection<Dim>& among, const CorePotential& core)
    : PairTerm<Dim>(among, law_of<Dim>(among.particles(), core)) {}

template class Contact<1>;
template class Contact<2>;
template class Contact<3>;

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/term.hpp>

#include <fmt/format.h>

namespace spam {

template <int Dim>
std::size_t Term<Dim>::pairs() const {
    std::size_t pairs = 0;
    for (const auto* near : neighbourhoods_) pairs += near->list().pairs();
    return pairs;
}

/// Lists for good are part of the law.
template <int Dim>
std::size_t Term<Dim>::list_builds() const {
    std::size_t builds = 0;
    for (const auto* near : neighbourhoods_)
        if (!near->for_good()) builds += near->list().builds();
    return builds;
}

template <int Dim>
void Term<Dim>::require_one_part(const std::string& what) const {
    if (!Parts::here().alone())
        throw InputError(fmt::format(
            "parts: {} cannot be parted, because neighbours in other parts are not known to it; run it in "
            "one part",
            what));
}

template class Term<1>;
template class Term<2>;
template class Term<3>;

}  // namespace spam

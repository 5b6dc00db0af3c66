// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/core/error.hpp>
#include <spam/core/parts.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/term.hpp>

#include <fmt/format.h>

namespace spam {

/// Lists for good are part of the law.
template <int Dim>
auto Term<Dim>::counts() const -> Counts {
    Counts counts;
    for (const auto* near : neighbourhoods_) {
        counts.pairs += near->list().pairs();
        if (!near->for_good()) counts.list_builds += near->list().builds();
    }
    return counts;
}

template <int Dim>
void Term<Dim>::require_one_part(const std::string& what) const {
    if (!Parts::here().alone())
        throw InputError(fmt::format(
            "ranks: {} cannot be parted, because neighbours in other parts are not known to it; leave "
            "--ranks out",
            what));
}

template class Term<1>;
template class Term<2>;
template class Term<3>;

}  // namespace spam

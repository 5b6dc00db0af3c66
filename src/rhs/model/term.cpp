// SPDX-License-Identifier: GPL-3.0-or-later
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/term.hpp>

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

SPAM_COMPILED(template class Term);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/core_potential.hpp>
#include <spam/rhs/pair_term.hpp>

namespace spam {

/// Contact of bodies: particles of different ones repel each other by a core (physics/contact.hpp), those of
/// the same one do not. Bodies are those of the particles when the term is made; what breaks off one stays
/// part of it.
template <int Dim>
class Contact final : public PairTerm<Dim> {
  public:
    /// Throws InputError for an energy or a range that is not above 0, and for a periodic box narrower than
    /// a fifth of the range.
    Contact(const Selection<Dim>& among, const CorePotential& core);
};

extern template class Contact<1>;
extern template class Contact<2>;
extern template class Contact<3>;

}  // namespace spam

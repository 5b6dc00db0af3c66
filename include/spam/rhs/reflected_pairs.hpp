// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/term.hpp>

namespace spam {

/// The restriction of the distance of closest approach (physics/closest_approach.hpp; [HHM04] IV) beside any law:
/// pairs that approach are reflected at the distance R. No force; p, L and E stay as they are.
template <int Dim>
class ReflectedPairs final : public Term<Dim> {
  public:
    /// `distance`: R > 0, below the spacing. Throws InputError for another, and where a periodic length is not above
    /// 2 R.
    ReflectedPairs(const Selection<Dim>& among, double distance);

    using typename Term<Dim>::Now;
    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;
    std::string rates(const Now& now) override;
    Answer answer(Ask, std::span<const double>) const override { return {}; }
};

SPAM_COMPILED(extern template class ReflectedPairs);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/pair_term.hpp>

namespace spam {

namespace field_kind {
/// What artificial viscosity has taken from the motion, by mass.
inline constexpr FieldKind viscous_heat{"viscous_heat", Rank::scalar, Role::integrated, "l^2/t^2"};
}  // namespace field_kind

/// Von Neumann's artificial viscosity beside any law: the force of physics/viscosity.hpp, [HHM04] IV, between the
/// present neighbours, for solids that remember (total Lagrangian, material vectors, springs), elements and potentials,
/// whose own law knows no `Scheme::viscosity`. Densities are those of the start. It keeps p exactly, L and E to
/// integrator error, E with what it takes from the motion, which y holds as `viscous_heat`: it does not heat the
/// material.
template <int Dim>
class ArtificialViscosity final : public PairTerm<Dim> {
  public:
    struct Constants {
        double alpha = 1.0;            ///< of the linear term; the quadratic one is twice that
        double range = 0.0;            ///< of the weight function
        double density = 0.0;          ///< at the start
        double sound_speed = 0.0;      ///< longitudinal, at the start
        Kernel kernel = Kernel::lucy;  ///< of the weight function
    };
    /// Throws InputError for constants that are not above 0, a range below a spacing, and a periodic box narrower than
    /// a fifth of the range.
    ArtificialViscosity(const Selection<Dim>& among, const Constants& constants);
};

SPAM_COMPILED(extern template class ArtificialViscosity);

}  // namespace spam

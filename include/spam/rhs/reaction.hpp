// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/kernel.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>
#include <vector>

namespace spam {

template <int Dim>
struct Sweeps;
template <int Dim>
class PackedParticles;

namespace field_kind {
inline constexpr FieldKind concentration{"concentration", Rank::scalar, Role::integrated, "1", 5};
}  // namespace field_kind

/// A reaction A -> B that spreads: how fast it goes, and what it gives.
struct ReactionScheme {
    double diffusivity = 1.0;  ///< D
    double rate = 1.0;         ///< r
    double threshold = 0.25;   ///< a: below this concentration B goes back to A
    double heat = 0.0;         ///< q, by the mass that has reacted
    Kernel kernel = Kernel::lucy;
    double range = 3.0;
};

/// A species in y beside other laws, [HH01]: c_i, its share in the mass of particle i, 1 - c_i that of the other one,
///     c_dot = 1/rho div(D rho grad c) + R(c),   R = r c (1 - c)(c - a),   e_dot += q R,
/// with densities summed over the range. Fick's flux is summed like heat in a fluid that conducts
/// (physics/fick_flux.hpp): what one particle loses its partner gains, and diffusion keeps sum m c to rounding. The
/// energy that has not reacted, sum m q (1 - c), is the term's. A front between c = 1 and 0 moves at
/// sqrt(r D/2)(1 - 2 a), and is sqrt(8 D/r) wide.
template <int Dim>
class Reaction final : public Term<Dim> {
  public:
    using typename Term<Dim>::Now;
    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;

    /// Throws InputError for a diffusivity or a rate below 0 or both 0, for a threshold that is no number, for a
    /// range as SmoothParticles does, and for heat where no law before this one has energies in y.
    Reaction(const Selection<Dim>& among, const ReactionScheme& scheme);
    ~Reaction() override;

    std::string rates(const Now& now) override;
    Answer answer(Ask what, std::span<const double> y) const override;

    const ReactionScheme& scheme() const { return scheme_; }

  private:
    ReactionScheme scheme_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
    std::vector<double> rho_;
};

SPAM_COMPILED(extern template class Reaction);

}  // namespace spam

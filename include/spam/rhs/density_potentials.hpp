// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/kernel.hpp>
#include <spam/material/fluid.hpp>
#include <spam/physics/core_potential.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>

namespace spam {

template <int Dim>
class PackedParticles;

/// Which potentials of the density act, [HH07] 6 to 8, and with what weight function. Zero: none.
struct DensityPotentials {
    std::optional<AnyEquationOfState> state{};  ///< a cold law: energy m e(rho)
    double surface_tension = 0.0;               ///< s_g, physics/surface_tension.hpp
    double strength = 0.0;                      ///< s_c, physics/curvature_strength.hpp
    CorePotential core{0.0, 0.0};               ///< e_c and s
    Kernel kernel = Kernel::lucy;
    double range = 3.0;

    /// "embedded atom, B0 = 1, rho0 = 1; surface tension 0.1; core 0.1 of range 0.7; w5 weight of range 3"
    std::string describe() const;
};

/// Molecular dynamics with potentials of the density: y = (x, v), m v_dot = -d Phi/d r. Keeps p
/// exactly, E to integrator error, and in open space L as well.
template <int Dim>
class DensityPotentialTerm final : public Term<Dim> {
  public:
    /// Throws InputError where nothing acts, the law is not cold, the weight function is not smooth
    /// enough for a potential (physics/density_potential.hpp), a potential needs more dimensions, a
    /// strength, energy or range makes no sense (the core's must be below the range), or a periodic box
    /// is narrower than a fifth of the range.
    DensityPotentialTerm(const Selection<Dim>& among, const DensityPotentials& potentials);
    ~DensityPotentialTerm() override;

    using typename Term<Dim>::Now;
    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;
    std::string rates(const Now& now) override;
    /// Its energy is Phi, its density sum_j m_j w_ij, self included.
    Answer answer(Ask what, std::span<const double> y) const override;

    const DensityPotentials& potentials() const { return potentials_; }

  private:
    struct Parts;
    std::string complaint() const;
    double phi(std::span<const double> y) const;
    std::vector<double> summed_density(std::span<const double> y) const;

    DensityPotentials potentials_;
    std::unique_ptr<Parts> parts_;  ///< sweeps, records and fields
};

SPAM_COMPILED(extern template class DensityPotentialTerm);

/// Potentials of the density and nothing else.
template <int Dim>
using DensityPotentialModel = ModelOf<Dim, DensityPotentialTerm<Dim>, DensityPotentials>;

}  // namespace spam

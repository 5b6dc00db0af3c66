// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/general_weight.hpp>
#include <spam/material/hyperelastic_material.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>

namespace spam {

template <int Dim>
struct SweepInput;
template <int Dim>
struct Sweeps;

/// How a total-Lagrangian solid is summed.
struct TotalLagrangianScheme {
    double
        density;  ///< rho_0 of the reference configuration; sqrt(4/3) m in the triangular lattice
    double range = 3.0;  ///< of the weight function
    /// kappa, against zero-energy modes, in units of the stiffness of the stiffest law; 0 leaves them free.
    double penalty = 0.1;
    Kernel kernel = Kernel::lucy;  ///< the weight function
};

/// An elastic solid of smooth particles that remembers its reference configuration X: y =
/// (x, v, history of the material); neighbours and weights are those of particles().reference_position for good,
/// stresses follow from the deformation gradient. All forces derive from one energy that rotations leave unchanged:
/// p is kept exactly, E and in open space L to integrator error, and there is no tensile instability. It yields
/// where its material does, but does not break: neighbours stay neighbours.
template <int Dim>
class TotalLagrangian final : public Term<Dim> {
  public:
    /// `material`: any hyperelastic law (hyperelastic_law.hpp), with a memory or without. In a periodic box the
    /// lattice closes on itself as in the reference configuration; a mirror is a plane of symmetry for particles
    /// that have neighbours behind it there, and turns back any particle that reaches it. Throws InputError for a
    /// density, range or penalty that makes no sense, a periodic box narrower than a fifth of the range, and a
    /// particle whose neighbours do not span space.
    TotalLagrangian(const Selection<Dim>& among, const HyperelasticMaterial<Dim>& material,
                    const TotalLagrangianScheme& scheme);
    ~TotalLagrangian() override;

    using typename Term<Dim>::Now;
    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;
    std::string rates(const Now& now) override;
    bool settle(double t, const State<Dim>& state) override;
    /// Its energy is the potential of the forces: sum V energy(F), and k_ij |d_ij|^2/2 of every pair. Of a material
    /// with a memory with what it has spent on plastic flow: that is kept as well, across steps and settling. Its
    /// density is rho_0/det F, negative where a particle is turned inside out.
    Answer answer(Ask what, std::span<const double> y) const override;

    const TotalLagrangianScheme& scheme() const { return scheme_; }

  private:
    struct Stresses;
    SweepInput<Dim> input(const Neighbourhood<Dim>& near) const;
    void pack_reference();
    void find_corrections();
    void load(const ConstState<Dim>& state, Neighbourhood<Dim>& near) const;
    void memory_rates(const Now& now);
    std::vector<Mat<Dim>> gradients(std::span<const double> y) const;
    double potential_energy(std::span<const double> y) const;
    Neighbourhood<Dim> deformed(std::span<const double> y) const;
    std::string complaint() const;

    HyperelasticMaterial<Dim> material_;
    TotalLagrangianScheme scheme_;
    GeneralWeight<Dim> weight_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    Neighbourhood<Dim> near_;  ///< of the reference positions, StressedRecord
    /// Of velocities, where the material's memory has rates.
    std::unique_ptr<Neighbourhood<Dim>> moving_;
};

SPAM_COMPILED(extern template class TotalLagrangian);

/// A total-Lagrangian solid and nothing else.
template <int Dim>
using TotalLagrangianModel =
    ModelOf<Dim, TotalLagrangian<Dim>, HyperelasticMaterial<Dim>, TotalLagrangianScheme>;

}  // namespace spam

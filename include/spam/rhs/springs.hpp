// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/harmonic_spring.hpp>
#include <spam/rhs/particle_model.hpp>

#include <cstdint>

namespace spam {

/// Molecular dynamics of points bound to their initial nearest neighbours by harmonic springs, the
/// paper's reference solution, [HHM04] VI: y = (x, v). Keeps p exactly, L and E to integrator
/// error.
template <int Dim>
class Springs final : public Term<Dim> {
  public:
    /// Bonds every pair closer than 1.2 spacings in the reference configuration.
    using typename Term<Dim>::Now;

    Springs(const Selection<Dim>& among, const HarmonicSpring& spring);

    std::string rates(const Now& now) override;
    double energy(std::span<const double> y) const override;
    std::string no_images(const Wall<Dim>&) const override {
        return "the neighbours of a particle are those of the reference configuration, without images; use rigid sides";
    }
    std::string describe() const override;
    /// Throws InputError where particles are split or merged: all springs have one length.
    void take_over(const Term<Dim>& before, const ConstState<Dim>& was, const Change<Dim>& change,
                   const ConstState<Dim>& now) override;

    /// Stress of every particle from its own bonds (virial), tension-positive:
    /// sigma_i = -1/(2 V) sum_j r_ij (x) F_ij, V the volume of a particle.
    std::vector<SymTensor<Dim>> stress(std::span<const double> y, double volume) const;
    /// Of all bonds, from both ends.
    double neighbour_forces(std::span<const double> y) const override;
    std::size_t pairs() const override { return partner_.size() / 2; }
    double reach() const override { return bond_reach_; }

  private:
    template <class View>
    Point<Dim> bond(const View& x, std::size_t i, std::size_t j) const;

    HarmonicSpring spring_;
    double bond_reach_;
    std::vector<std::size_t> start_;      ///< N + 1
    std::vector<std::uint32_t> partner_;  ///< every bond from both its ends, ascending
};

extern template class Springs<1>;
extern template class Springs<2>;
extern template class Springs<3>;

/// Springs and nothing else.
template <int Dim>
class BondedModel final : public ParticleModel<Dim> {
  public:
    BondedModel(Particles<Dim> particles, const HarmonicSpring& spring, const Box<Dim>& box = {})
        : ParticleModel<Dim>(std::move(particles), box),
          law(this->template add_term<Springs<Dim>>(spring)) {}

    /// Springs::stress()
    std::vector<SymTensor<Dim>> stress(std::span<const double> y, double volume) const {
        return law.stress(y, volume);
    }

    Springs<Dim>& law;
};

}  // namespace spam

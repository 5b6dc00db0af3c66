// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/harmonic_spring.hpp>
#include <spam/neighbors/neighbourhood.hpp>
#include <spam/rhs/pair_forces.hpp>
#include <spam/rhs/particle_model.hpp>

namespace spam {

/// Molecular dynamics of points bound to their initial nearest neighbours by harmonic springs, the
/// paper's reference solution, [HHM04] VI: y = (x, v). Keeps p exactly, L and E to integrator
/// error.
template <int Dim>
class Springs final : public Term<Dim>, public ForcesOfPairs<Dim> {
  public:
    using typename Term<Dim>::Now;

    /// Bonds every pair closer than 1.2 spacings in the reference configuration, across periodic borders and with
    /// the images behind a mirror as well. Throws InputError where two of these are at one place.
    Springs(const Selection<Dim>& among, const HarmonicSpring& spring);

    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;
    std::string rates(const Now& now) override;
    /// Its neighbour forces are those of all bonds, from both ends.
    Answer answer(Ask what, std::span<const double> y) const override;
    std::optional<std::vector<PairForce<Dim>>> pair_forces(
        std::span<const double> y) const override;
    /// Throws InputError where particles are split or merged: all springs have one length.
    void take_over(const Term<Dim>& before, const ConstState<Dim>& was, const Change<Dim>& change,
                   const State<Dim>& now) override;

    /// Stress of every particle from its own bonds (virial), tension-positive:
    /// sigma_i = -1/(2 V) sum_j r_ij (x) F_ij, V the volume of a particle.
    std::vector<SymTensor<Dim>> stress(std::span<const double> y, double volume) const;

  private:
    void load(Neighbourhood<Dim>& near, const double* x) const;
    template <class Visit>
    static void each_bond(const Neighbourhood<Dim>& near, std::size_t slot, const Visit& visit);
    template <class OfBond>
    double half_of_bonds(std::span<const double> y, const OfBond& of_bond) const;

    HarmonicSpring spring_;
    Neighbourhood<Dim> near_;  ///< of the reference positions; the records are positions
};

SPAM_COMPILED(extern template class Springs);

/// Springs and nothing else.
template <int Dim>
using BondedModel = ModelOf<Dim, Springs<Dim>, HarmonicSpring>;

}  // namespace spam

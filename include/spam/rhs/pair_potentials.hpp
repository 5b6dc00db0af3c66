// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/cohesive_potential.hpp>
#include <spam/physics/core_potential.hpp>
#include <spam/rhs/pair_term.hpp>
#include <spam/rhs/particle_model.hpp>

namespace spam {

/// A repulsive core between all particles, phi = e_c (1 - r^2/s^2)^4 inside s (physics/core_potential.hpp):
/// it keeps neighbours apart where stresses pull them together.
template <int Dim>
class Core final : public PairTerm<Dim> {
  public:
    /// Throws InputError for an energy or a range that is not above 0, and for a periodic box narrower than
    /// a fifth of the range.
    Core(const Selection<Dim>& among, const CorePotential& core);
};

/// Molecular dynamics of particles that hold together, [HH07] 13 (physics/cohesive_potential.hpp).
template <int Dim>
class Cohesion final : public PairTerm<Dim> {
  public:
    /// Throws InputError for an energy or a spacing that is not above 0, and for a periodic box narrower than
    /// a fifth of the range.
    explicit Cohesion(const Selection<Dim>& among, const CohesivePotential& potential = {});
};

/// Forces without a range between all particles, by direct sums over N (N - 1)/2 pairs (physics/long_range.hpp):
/// Phi = sum s q_i q_j/sqrt(r^2 + eps^2), in the plane too.
struct LongRangeScheme {
    double strength = -1.0;        ///< s: -G of gravity; above 0 like charges repel each other
    double softening = 0.1;        ///< eps
    std::vector<double> charge{};  ///< N; empty: the masses
};

template <int Dim>
class LongRange final : public PairTerm<Dim> {
  public:
    /// Throws InputError for a strength of 0, for a softening below 0, or of 0 where some particles attract each
    /// other, for charges that are not one for each particle, and for a periodic box.
    LongRange(const Selection<Dim>& among, const LongRangeScheme& scheme);
};

/// Molecular dynamics with a weight function as pair potential, phi = a m_i m_j w(r); Lucy's in [HHM04] III.
template <int Dim>
class WeightPotential final : public PairTerm<Dim> {
  public:
    /// `range`: of the weight function, > spacing. Throws InputError for another, and for a periodic
    /// box that is narrower than a fifth of the range.
    WeightPotential(const Selection<Dim>& among, double range, double a = 1.0,
                    Kernel kernel = Kernel::lucy);
};

/// The latter and nothing else.
template <int Dim>
class PairPotentialModel final : public ParticleModel<Dim> {
  public:
    PairPotentialModel(Particles<Dim> particles, double range, const Box<Dim>& box = {},
                       Kernel kernel = Kernel::lucy)
        : ParticleModel<Dim>(std::move(particles), box) {
        this->template add_term<WeightPotential<Dim>>(range, 1.0, kernel);
    }
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/particle_model.hpp>

#include <memory>

namespace spam {

template <int Dim>
struct Sweeps;
template <int Dim>
class PackedParticles;
enum class ListUse;

/// Molecular dynamics with Lucy's weight function as pair potential, m_i m_j w(r_ij): y = (x, v),
/// v_dot_i = -sum_j m_j grad_i w_ij. It moves like smooth particles of the gas P = rho^2/2,
/// [HH01]. Keeps p exactly, E to integrator error, and in open space L as well.
template <int Dim>
class LucyPairPotential final : public Term<Dim> {
  public:
    /// `range`: of the weight function, > spacing. Throws InputError for another, and for a periodic
    /// box that is not wider than twice the range.
    LucyPairPotential(Model<Dim>& model, double range);
    ~LucyPairPotential() override;

    using typename Term<Dim>::Now;
    std::string rates(const Now& now) override;
    /// sum over pairs of m_i m_j w_ij
    double energy(std::span<const double> y) const override;
    /// sum_j m_j w_ij, self included
    std::vector<double> density(std::span<const double> y) const override;
    std::string describe() const override;

    std::size_t pairs() const override;
    double reach() const override { return range_; }
    void remember(Archive& archive) override;
    std::size_t list_builds() const override;

  private:
    std::unique_ptr<PackedParticles<Dim>> packed_with(ListUse use) const;

    double range_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
};

extern template class LucyPairPotential<1>;
extern template class LucyPairPotential<2>;
extern template class LucyPairPotential<3>;

/// This potential and nothing else.
template <int Dim>
class PairPotentialModel final : public ParticleModel<Dim> {
  public:
    PairPotentialModel(Particles<Dim> particles, double range, const Box<Dim>& box = {})
        : ParticleModel<Dim>(std::move(particles), box) {
        this->template add_term<LucyPairPotential<Dim>>(range);
    }
};

}  // namespace spam

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
class PairPotentialModel final : public ParticleModel<Dim> {
  public:
    /// `range`: of the weight function, > spacing. Throws InputError for another, and for a periodic
    /// box that is not wider than twice the range.
    PairPotentialModel(Particles<Dim> particles, double range, const Box<Dim>& box = {});
    ~PairPotentialModel() override;

    std::size_t pairs() const override;
    double reach() const override { return range_; }
    void remember(Archive& archive) override;
    std::size_t list_builds() const;

  private:
    void pair_rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    /// sum over pairs of m_i m_j w_ij
    double pair_energy(std::span<const double> y) const override;
    /// sum_j m_j w_ij, self included
    std::vector<double> pair_density(std::span<const double> y) const override;
    Promises pair_promises() const override;
    std::string pair_description() const override;

    std::unique_ptr<PackedParticles<Dim>> packed_with(ListUse use) const;

    double range_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
};

extern template class PairPotentialModel<1>;
extern template class PairPotentialModel<2>;
extern template class PairPotentialModel<3>;

}  // namespace spam

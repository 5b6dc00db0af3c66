// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/material.hpp>
#include <spam/neighbors/pair_list.hpp>
#include <spam/physics/record.hpp>
#include <spam/rhs/model.hpp>

namespace spam {

/// A solid of smooth particles, [HHM04] II: y = (x, v, [rho], sigma, e). The scheme
/// decides whether density is part of y, what velocity moves the particles, and whether pair
/// torques are balanced.
template <int Dim>
class SmoothParticleModel final : public Model<Dim> {
  public:
    /// `material`: any stress law (stress_law.hpp). Throws InputError when the scheme makes no
    /// sense here (Scheme::validate) the range does not reach a neighbour,
    /// or a periodic box is not wider than twice the range.
    SmoothParticleModel(Particles<Dim> particles, const Material<Dim>& material,
                        const Scheme& scheme, const Box<Dim>& box = {});

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double internal_energy(std::span<const double> y) const override;
    std::vector<double> density(std::span<const double> y) const override;
    Promises promises() const override { return scheme_.promises(Dim); }
    std::string describe() const override;
    std::size_t pairs() const override { return (list_.entries() - list_.size()) / 2; }
    double reach() const override { return scheme_.range; }

    const Scheme& scheme() const { return scheme_; }
    /// R of each body in the latest rates(); 1 where torques are left free.
    std::span<const double> torque_factors() const { return torque_factor_; }
    std::size_t list_builds() const { return list_.builds(); }

  private:
    struct Choices;  // compile-time choices as sweeps, picked once (see the source)
    bool load(std::span<const double> y, std::span<double> y_dot);
    void sum_density();
    void form_A(std::span<const double> y);
    void balance_torques();
    void load_transport();
    bool density_is_physical(std::span<double> y_dot);

    template <class Weight, class Mean, class Transport, class Force>
    void first_sweep(std::span<double> y_dot);
    template <class Weight, class... Passes>
    void second_sweep(std::span<double> y_dot);

    using Sweep = void (SmoothParticleModel::*)(std::span<double>);
    Sweep first_sweep_ = nullptr;
    Sweep second_sweep_ = nullptr;  ///< nullptr where the first sweep finds everything

    Material<Dim> material_;
    Scheme scheme_;
    PairList<Dim> list_;
    std::vector<Record<Dim>> records_;
    std::vector<TransportRecord<Dim>> transport_records_;
    std::vector<Vec<Dim>> transport_velocity_;
    std::vector<Mat<Dim>> grad_v_;
    std::vector<double> positive_torque_, negative_torque_;  ///< per particle, TorqueSums
    std::vector<double> torque_factor_;                      ///< per body
    Points<Dim> position_;
};

extern template class SmoothParticleModel<1>;
extern template class SmoothParticleModel<2>;
extern template class SmoothParticleModel<3>;

}  // namespace spam

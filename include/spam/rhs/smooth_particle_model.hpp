// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/sums.hpp>
#include <spam/material/material.hpp>
#include <spam/rhs/model.hpp>

#include <memory>

namespace spam {

template <int Dim>
struct Sweeps;
template <int Dim>
class PackedParticles;
enum class ListUse;
struct PackedFields;

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

    ~SmoothParticleModel() override;

    void rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double internal_energy(std::span<const double> y) const override;
    std::vector<double> density(std::span<const double> y) const override;
    /// The scheme's; in a periodic box no scheme keeps the angular momentum about the origin, because
    /// forces across the border act at the images of particles.
    Promises promises() const override {
        Promises promises = scheme_.promises(Dim);
        if (this->box().periodic()) promises.angular_momentum = Promise::not_kept;
        return promises;
    }
    std::string describe() const override;
    std::size_t pairs() const override;
    double reach() const override { return scheme_.range; }

    const Scheme& scheme() const { return scheme_; }
    /// R of each body in the latest rates(); 1 where torques are left free.
    std::span<const double> torque_factors() const { return torque_factor_; }
    std::size_t list_builds() const;

  private:
    bool load(std::span<const double> y, std::span<double> y_dot);
    PackedFields fields(std::span<const double> y) const;
    std::unique_ptr<PackedParticles<Dim>> packed_with(ListUse use) const;
    bool fail_density(std::span<const double> rho, std::span<double> y_dot);
    void balance_torques(std::span<const double> y, std::span<const double> u);
    void load_transport(std::span<const double> u);

    Material<Dim> material_;
    Scheme scheme_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
    std::vector<double> summed_density_;
    std::vector<double> positive_torque_, negative_torque_;  ///< per particle, TorqueSums
    struct BodySums {
        CompensatedSum P, M, X;  ///< torque_balance()
    };
    std::vector<BodySums> body_sums_;
    std::vector<double> torque_factor_;  ///< per body
};

extern template class SmoothParticleModel<1>;
extern template class SmoothParticleModel<2>;
extern template class SmoothParticleModel<3>;

}  // namespace spam

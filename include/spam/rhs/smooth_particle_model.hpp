// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/material.hpp>
#include <spam/physics/viscosity.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>

namespace spam {

template <int Dim>
struct Sweeps;
template <int Dim>
class PackedParticles;
enum class ListUse;
struct PackedFields;
struct Groups;
class TorqueFactors;
struct TorqueScale;
class GaussForces;

/// A solid of smooth particles, [HHM04] II: y = (x, v, [rho], sigma, e). The scheme
/// decides whether density is part of y, what velocity moves the particles, and what keeps the
/// angular momentum.
template <int Dim>
class SmoothParticleModel final : public ParticleModel<Dim> {
  public:
    /// `material`: any stress law (stress_law.hpp). Throws InputError when the scheme makes no
    /// sense here (Scheme::validate), the range does not reach a neighbour, pairs are to be reflected at
    /// the spacing or beyond, a periodic box is not wider than twice the range, or the law tells no
    /// sound speed and the scheme has viscosity.
    SmoothParticleModel(Particles<Dim> particles, const Material<Dim>& material,
                        const Scheme& scheme, const Box<Dim>& box = {});

    ~SmoothParticleModel() override;

    /// Not with particle torques, which jump where one changes its sign, nor with Gauss' principle, which
    /// sets in and out.
    bool smooth() const override {
        return scheme_.angular_momentum != AngularMomentum::torque_particle &&
               scheme_.angular_momentum != AngularMomentum::gauss;
    }
    std::size_t pairs() const override;
    double reach() const override { return scheme_.range; }

    const Scheme& scheme() const { return scheme_; }
    /// R and 1/R of each body (of all with Balance::global) in the latest rates(); empty where torques
    /// are left free.
    std::span<const TorqueScale> torque_scales() const;

    /// Remarks when Gauss' constraint becomes singular and when it works again, with the health of its
    /// denominator (physics/gauss_constraint.hpp).
    std::vector<Remark> watch(double t, std::span<const double> y) override;
    void set_bodies(std::vector<std::int32_t> bodies) override;
    void remember(Archive& archive) override;
    std::size_t list_builds() const;

  private:
    void pair_rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double pair_energy(std::span<const double> y) const override;
    std::vector<double> pair_density(std::span<const double> y) const override;
    /// The scheme's; in a periodic box no scheme keeps the angular momentum about the origin, because
    /// forces across the border act at the images of particles.
    Promises pair_promises() const override { return this->in_box(scheme_.promises(Dim)); }
    /// The restriction of the distance of closest approach, where the scheme has one.
    std::vector<Event> pair_events() const override;
    std::string pair_description() const override;
    double pair_damping() const override { return viscous_damping_; }
    bool moves_with_velocity() const override { return scheme_.transport == Transport::plain; }

    bool load(std::span<const double> y, std::span<double> y_dot);
    PackedFields fields(std::span<const double> y) const;
    std::unique_ptr<PackedParticles<Dim>> packed_with(ListUse use) const;
    bool fail_density(std::span<const double> rho, std::span<double> y_dot);
    void load_transport(std::span<const double> u);
    ViscosityConstants viscosity();
    Groups groups() const;

    Material<Dim> material_;
    Scheme scheme_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
    ViscosityConstants viscosity_;
    double viscous_damping_ = 0.0;  ///< fastest_damping()
    std::vector<double> summed_density_;
    std::vector<std::int32_t> group_;  ///< per particle, what keeps its angular momentum
    std::size_t group_count_ = 1;
    std::unique_ptr<TorqueFactors> torques_;
    std::unique_ptr<GaussForces> gauss_;
    bool gauss_works_ = false;           ///< at the latest accepted state
    std::vector<double> watched_rates_;  ///< there
};

extern template class SmoothParticleModel<1>;
extern template class SmoothParticleModel<2>;
extern template class SmoothParticleModel<3>;

}  // namespace spam

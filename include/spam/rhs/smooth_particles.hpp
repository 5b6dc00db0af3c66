// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/fluid.hpp>
#include <spam/material/material.hpp>
#include <spam/physics/torque_balance.hpp>
#include <spam/physics/viscosity.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>

namespace spam {

template <int Dim>
struct Sweeps;
template <int Dim>
struct SweepInput;
template <int Dim>
struct SweepOutput;
template <int Dim>
class PackedParticles;
struct PackedFields;
struct Groups;
template <int Dim>
class TorqueFactors;
struct RestingBody;
template <int Dim>
class GaussForces;
template <int Dim>
class Constitution;

/// What balanced torques in space have taken so far: how often they were balanced, by how many sums over torques
/// in all (sweeps over pairs with torque_pair), and what is left of them by the sum of their sizes, the latest time.
struct TorqueSearch {
    std::size_t balances = 0, sums = 0;
    double residual = 0.0;
};

/// Smooth particles with stress and energy, [HHM04] II, [HH07] 4: y = (x, v, [rho], [sigma], e). The scheme
/// decides whether density is part of y, what velocity moves the particles, and what keeps the angular
/// momentum. Solids and fluids differ in where the stress comes from alone: a solid's is part of y, a
/// fluid's is made from density, energy and, with friction or conduction, gradients, or those are added by pairs.
template <int Dim>
class SmoothParticles final : public Term<Dim> {
  public:
    using typename Term<Dim>::Now;

    /// Solids of any stress law (stress_law.hpp), or fluids of any equation of state: the one at the place
    /// of a particle's material (Particles::material). Throws InputError when the scheme makes no sense
    /// here (Scheme::validate), the range does not reach a neighbour, pairs are to be reflected at the
    /// spacing or beyond, a periodic box is narrower than a fifth of the range, a particle's material is not
    /// there, a solid's law tells no sound speed and the scheme has viscosity, a fluid has conduction
    /// without temperature or negative coefficients (eta, bulk viscosity, kappa), some fluids have friction by
    /// pairs and others by gradients, or that of pairs has shear and torques are balanced, or its density is summed
    /// while its particles move with an averaged velocity; where particles are shifted, of a solid, of several
    /// fluids, of one without a sound speed at rest, and in a box that is open somewhere or not full.
    SmoothParticles(const Selection<Dim>& among, std::vector<Material<Dim>> solids,
                    const Scheme& scheme);
    /// The same of fluids.
    SmoothParticles(const Selection<Dim>& among, std::vector<Fluid> fluids, const Scheme& scheme);
    /// Of one solid.
    SmoothParticles(const Selection<Dim>& among, const Material<Dim>& solid, const Scheme& scheme)
        : SmoothParticles(among, std::vector<Material<Dim>>{solid}, scheme) {}
    /// Of one fluid.
    SmoothParticles(const Selection<Dim>& among, const Fluid& fluid, const Scheme& scheme)
        : SmoothParticles(among, std::vector<Fluid>{fluid}, scheme) {}
    ~SmoothParticles() override;

    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;
    std::string rates(const Now& now) override;
    Answer answer(Ask what, std::span<const double> y) const override;
    /// Remarks when Gauss' constraint becomes singular and when it works again, with the health of its
    /// denominator (physics/gauss_constraint.hpp); and likewise when the torques of a body in space cannot balance
    /// what ⟨v⟩ changes of its angular momentum.
    std::vector<Remark> watch(double t, std::span<const double> y) override;
    void set_bodies() override;
    void remember(Memory<Dim>& memory) override;
    bool settle(double t, const State<Dim>& state) override;
    void take_over(const Term<Dim>& before, const ConstState<Dim>& was, const Change<Dim>& change,
                   const State<Dim>& now) override;

    /// The choices it was made with.
    const Scheme& scheme() const { return scheme_; }
    /// R and 1/R of each body (of all with Balance::global) in the latest rates(); empty where torques
    /// are left free.
    std::span<const TorqueScale> torque_scales() const;
    /// In space, where there are multipliers in place of R.
    TorqueSearch torque_search() const;

    // Of fluids, as the functions of FluidModel (below). Precondition: the particles are fluid.
    /// The first of them.
    const Fluid& fluid() const;
    /// N; NaN outside the law.
    std::vector<double> pressure(std::span<const double> y) const;
    /// N; NaN outside the law. Precondition: the law is thermal.
    std::vector<double> temperature(std::span<const double> y) const;
    /// FluidModel::state(). Throws InputError among some of the particles, and for other than N positions or
    /// velocities.
    std::vector<double> start(const Points<Dim>& position, const Points<Dim>& velocity, double T);

  private:
    SmoothParticles(const Selection<Dim>& among, std::unique_ptr<Constitution<Dim>> constitution,
                    const Scheme& scheme);
    std::string load(const Now& now);
    std::string complaint(std::span<const double> rho) const;
    void balance(const Now& now, const SweepInput<Dim>& in, SweepOutput<Dim>& out);
    PackedFields fields_of(const ConstState<Dim>& state) const;
    std::vector<double> summed_density(const PackedFields& fields) const;
    void load_transport(const Now& now);
    void set_nature();
    double fastest_damping_in(std::span<const double> y) const;
    void prepare_damping();
    Groups groups() const;

    std::unique_ptr<Constitution<Dim>> constitution_;
    Scheme scheme_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
    ViscosityConstants viscosity_;
    double shifting_ = 0.0;                    ///< its coefficient D
    std::unique_ptr<const RestingBody> rest_;  ///< where something is damped
    std::vector<double> summed_density_;
    std::vector<double> heat_;         ///< by conduction, where work is found after it
    std::vector<std::int32_t> group_;  ///< per particle, what keeps its angular momentum
    std::size_t group_count_ = 1;
    std::unique_ptr<TorqueFactors<Dim>> torques_;
    std::unique_ptr<GaussForces<Dim>> gauss_;
    bool gauss_works_ = false;           ///< at the latest accepted state
    bool torques_fail_ = false;          ///< likewise: what is left of a balance in space
    std::vector<double> watched_rates_;  ///< there
};

SPAM_COMPILED(extern template class SmoothParticles);

/// A solid of smooth particles and nothing else.
template <int Dim>
class SmoothParticleModel final : public ParticleModel<Dim> {
  public:
    /// `material`: a stress law, or a Material. Throws InputError as SmoothParticles does.
    SmoothParticleModel(Particles<Dim> particles, const Material<Dim>& material,
                        const Scheme& scheme, const Box<Dim>& box = {})
        : ParticleModel<Dim>(std::move(particles), box),
          law(this->template add_term<SmoothParticles<Dim>>(material, scheme)) {}

    /// The choices it was made with.
    const Scheme& scheme() const { return law.scheme(); }
    /// R and 1/R of each body in the latest rates(); empty where torques are left free, and in space.
    std::span<const TorqueScale> torque_scales() const { return law.torque_scales(); }
    /// In space, where there are multipliers in place of R.
    TorqueSearch torque_search() const { return law.torque_search(); }

    /// Its one term.
    SmoothParticles<Dim>& law;
};

/// A fluid of smooth particles and nothing else.
template <int Dim>
class FluidModel final : public ParticleModel<Dim> {
  public:
    /// `fluid`: an equation of state, or a Fluid with friction and conduction. Throws InputError as SmoothParticles
    /// does.
    FluidModel(Particles<Dim> particles, const Fluid& fluid, const Scheme& scheme,
               const Box<Dim>& box = {})
        : ParticleModel<Dim>(std::move(particles), box),
          law(this->template add_term<SmoothParticles<Dim>>(fluid, scheme)) {}

    /// The fluid it was made of.
    const Fluid& fluid() const { return law.fluid(); }
    /// The choices it was made with.
    const Scheme& scheme() const { return law.scheme(); }
    /// N each; NaN outside the law. Precondition of temperature(): fluid().state.thermal.
    std::vector<double> pressure(std::span<const double> y) const { return law.pressure(y); }
    /// N; NaN outside the law. Precondition: fluid().state.thermal.
    std::vector<double> temperature(std::span<const double> y) const { return law.temperature(y); }
    /// y at `position` (Dim x N) with these velocities, densities summed there where y carries them, and
    /// the energy of temperature T (thermal law) or the cold energy (T is then not read), else none.
    /// Scales of the layout are set for the tolerances.
    std::vector<double> state(const Points<Dim>& position, const Points<Dim>& velocity,
                              double T = 0.0) {
        return law.start(position, velocity, T);
    }

    /// Its one term.
    SmoothParticles<Dim>& law;
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
// Where the stress of smooth particles comes from.
#pragma once

#include "../sweeps/packed_particles.hpp"
#include "../sweeps/term_sweeps.hpp"
#include "fluids.hpp"
#include "resting_body.hpp"
#include <spam/material/material.hpp>
#include <spam/rhs/term.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spam {

/// The materials of smooth particles, and what sweeps need of them.
template <int Dim>
class Constitution {
  public:
    using Now = typename Term<Dim>::Now;

    /// The materials of `particles`; Particles::material says which particle has which.
    explicit Constitution(const Particles<Dim>& particles) : particles_(particles) {}
    virtual ~Constitution() = default;
    Constitution(const Constitution&) = delete;
    Constitution& operator=(const Constitution&) = delete;

    virtual std::size_t materials() const = 0;
    virtual Matter matter(const Scheme& scheme) const = 0;
    /// How many numbers its own sweeps read of a particle, beyond those of the scheme; 0 without.
    virtual int numbers(const Scheme&) const { return 0; }
    /// The scheme of all that follows. Throws InputError where the materials do not go with it.
    virtual void take(const Scheme& scheme) = 0;
    /// Of y, besides the density.
    virtual std::vector<Field> fields() const = 0;
    /// "a solid of ...", without the scheme.
    virtual std::string describe() const = 0;
    /// Whether forces act along r_ij with this scheme.
    virtual bool central(const Scheme& scheme) const = 0;
    /// Whether the stress is a smooth function of the state.
    virtual bool smooth() const { return true; }
    /// sigma of all particles, for records; null where density and energy tell it.
    virtual const double* stress(const ConstState<Dim>&) const { return nullptr; }
    /// The same for a right-hand side, which counts with what trial stresses are returned to.
    virtual const double* returned_stress(const Now& now) { return stress(now.state); }

    /// Once densities are known (N): whatever records need beyond them before the sweep of forces. Returns
    /// why that has no meaning; empty where it has one.
    virtual std::string prepare(const Now&, std::span<const double>, const SweepInput<Dim>&,
                                const Sweeps<Dim>&, PackedParticles<Dim>&) {
        return {};
    }
    /// Once all other forces are known: those that the scheme's sweeps leave out, on top of these. Records hold
    /// something else afterwards.
    virtual void add_forces(std::span<const double> /*rho*/, const SweepInput<Dim>&,
                            const SweepOutput<Dim>&, PackedParticles<Dim>&) {}
    /// What the sweep of forces calls for every block of particles.
    virtual void close_forces(const Now&, SweepOutput<Dim>&) {}
    /// What passes that know the material are made with.
    virtual void set_constants(PassConstants&) const {}

    /// At this density and no energy.
    virtual std::optional<double> sound_speed(double density) const = 0;
    /// Of particle i after prepare(); for fluids.
    virtual double sound_speed_of(std::size_t) const { return 0.0; }
    /// The fastest at these densities and energies, of a solid at rest.
    virtual double fastest_sound(const RestingBody& rest, std::span<const double> /*rho*/,
                                 std::span<const double> /*e*/) const {
        return sound_speed(rest.density).value_or(0.0);
    }
    /// Term::fastest_damping() of friction and conduction at these densities and energies.
    virtual double damping(const GeneralWeight<Dim>&, const RestingBody&,
                           std::span<const double> /*rho*/, std::span<const double> /*e*/) const {
        return 0.0;
    }
    /// Term::conducts()
    /// Whether the energy of some particles is a function of their density.
    virtual bool cold() const { return false; }
    /// Term::Nature::no_rezoning
    std::string why_not_rezoned(const Scheme& scheme) const {
        if (cold())
            return "the energy of '" + describe() +
                   "' is a function of the density, and nothing can pay for its change; use a law with an energy, "
                   "such as GammaGas";
        return scheme.closest_approach > 0.0
                   ? "the closest approach remembers pairs of particles; leave --closest-approach out"
                   : "";
    }
    virtual bool conducts() const { return false; }
    /// Whether there is friction or conduction.
    virtual bool diffuses() const { return false; }
    /// Term::neighbour_forces() of the stress, by the spacing.
    virtual double stress_forces(const ConstState<Dim>& state,
                                 std::span<const double> rho) const = 0;
    virtual bool settle(double, const State<Dim>&) { return false; }

  protected:
    const Particles<Dim>& particles_;
};

/// Throws InputError where a particle's material is none of so many.
template <int Dim>
void check_materials(const Particles<Dim>& particles, std::size_t materials);

template <int Dim>
std::unique_ptr<Constitution<Dim>> solid_constitution(const Particles<Dim>& particles,
                                                      std::vector<Material<Dim>> solids);

/// The constitution of fluids, which can be asked for what only fluids have.
template <int Dim>
class FluidConstitution final : public Constitution<Dim> {
  public:
    using typename Constitution<Dim>::Now;

    FluidConstitution(const Particles<Dim>& particles, std::vector<Fluid> fluids);

    std::size_t materials() const override { return fluids_.size(); }
    Matter matter(const Scheme& scheme) const override;
    int numbers(const Scheme& scheme) const override;
    void take(const Scheme& scheme) override;
    std::vector<Field> fields() const override { return {Field::energy}; }
    std::string describe() const override;
    bool central(const Scheme& scheme) const override;
    std::string prepare(const Now& now, std::span<const double> rho, const SweepInput<Dim>& in,
                        const Sweeps<Dim>& sweeps, PackedParticles<Dim>& packed) override;
    void add_forces(std::span<const double> rho, const SweepInput<Dim>& in,
                    const SweepOutput<Dim>& out, PackedParticles<Dim>& packed) override;
    void set_constants(PassConstants& constants) const override;
    std::optional<double> sound_speed(double density) const override;
    double sound_speed_of(std::size_t i) const override;
    double fastest_sound(const RestingBody& rest, std::span<const double> rho,
                         std::span<const double> e) const override;
    double damping(const GeneralWeight<Dim>& weight, const RestingBody& rest,
                   std::span<const double> rho, std::span<const double> e) const override;
    bool conducts() const override { return any(fluids_, spam::conducts); }
    bool diffuses() const override { return any(fluids_, spam::diffuses); }
    bool cold() const override { return any(fluids_, spam::cold); }
    double stress_forces(const ConstState<Dim>& state, std::span<const double> rho) const override;

    const Fluid& of(std::size_t i) const;
    const Fluid& first() const { return fluids_.front(); }
    /// Pressures, say, of all particles.
    using Value = double (AnyEquationOfState::*)(double rho, double e) const;
    std::vector<double> of_all(Value value, std::span<const double> rho,
                               std::span<const double> e) const;

  private:
    void find_pressures(std::span<const double> rho, std::span<const double> e);
    std::string complaint(std::span<const double> rho, std::span<const double> e) const;
    void fill(std::span<const double> rho, const PassConstants& constants,
              PackedParticles<Dim>& packed) const;
    void close_gradients(const SweptBlock& block, std::span<const double> rho);
    void load_fluxes(PackedParticles<Dim>& packed) const;

    std::vector<Fluid> fluids_;
    bool thermal_, gradients_;
    Matter matter_ = Matter::inviscid;
    Sweep<Dim> friction_ = nullptr;    ///< of pairs, where the scheme's own sweeps have none
    std::span<const double> rho_, e_;  ///< of the latest prepare()
    std::vector<double> pressure_, temperature_;
    std::vector<std::pair<SymTensor<Dim>, Vec<Dim>>> fluxes_;  ///< A and q, by slot
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/general_weight.hpp>
#include <spam/material/fluid.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>

namespace spam {

struct RestingBody;
template <int Dim>
struct Sweeps;
template <int Dim>
class PackedParticles;

/// How a fluid with ranges of its own is summed.
struct VariableRangeScheme {
    double range = 3.0;  ///< eta: h = eta (m/rho)^(1/D), the range where mass per volume is one
    Kernel kernel = Kernel::lucy;
    /// Change of the ranges left out of the forces (Omega = 1), as older codes do, for comparison: p is
    /// still kept exactly, L and E to integrator error, but e no longer is the work done on the density.
    bool without_gradients = false;

    std::string describe() const;
};

/// Fluids whose particles have ranges that follow their densities
/// (physics/variable_range.hpp): y = (x, v, rho, e). The density is part of y, summed at the start and
/// then integrated, so that ranges are a function of y and no equation is solved in the rates. Keeps m and p
/// exactly, E = sum m (e + v^2/2) and in open space L to integrator error; friction by pairs takes L where its
/// forces act across r_ij.
template <int Dim>
class OwnRanges final : public Term<Dim> {
  public:
    /// Of several fluids the one at the place of a particle's material (Particles::material). Throws InputError where
    /// eta is so small that a particle would be its own only neighbour, for friction or conduction by gradients
    /// (Fluid::by_pairs), where a particle's material is not there, and as SmoothParticles for coefficients.
    OwnRanges(const Selection<Dim>& among, std::vector<Fluid> fluids,
              const VariableRangeScheme& scheme);
    OwnRanges(const Selection<Dim>& among, const Fluid& fluid, const VariableRangeScheme& scheme)
        : OwnRanges(among, std::vector<Fluid>{fluid}, scheme) {}
    ~OwnRanges() override;

    using typename Term<Dim>::Now;
    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;
    /// A range that has grown to half of a periodic length ends the run.
    std::string rates(const Now& now) override;
    Answer answer(Ask what, std::span<const double> y) const override;
    /// Densities and ranges that belong to each other are found anew, as at a start.
    void take_over(const Term<Dim>& before, const ConstState<Dim>& was, const Change<Dim>& change,
                   const State<Dim>& now) override;

    /// The first of them.
    const Fluid& fluid() const { return fluids_.front(); }
    const VariableRangeScheme& scheme() const { return scheme_; }
    /// h of all particles.
    std::vector<double> ranges(std::span<const double> y) const;

    /// y at `position` (Dim x N) with these velocities: densities and ranges that belong to each other, by
    /// Newton's method; energies as FluidModel::state(). Throws InputError where a range would have to
    /// reach half of a periodic length.
    std::vector<double> start(const Points<Dim>& position, const Points<Dim>& velocity, double T);
    /// N densities, each summed with its particle's own range, of particles at `position`.
    std::vector<double> solve_densities(const Points<Dim>& position) const;

  private:
    const Fluid& of(std::size_t i) const;
    double range_of(std::size_t i, double rho) const;
    double between_walls() const;
    double most_range() const;
    double resting_range() const;
    std::string find_ranges(const ConstState<Dim>& state);
    std::size_t close_own_sums(const Now& now);
    void load_friction(const Now& now);
    double fastest_damping_in(std::span<const double> y) const;
    void make_room();

    std::vector<Fluid> fluids_;
    VariableRangeScheme scheme_;
    GeneralWeight<Dim> unit_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
    std::unique_ptr<const RestingBody> rest_;  ///< of friction and conduction
    std::vector<double> range_, pressure_, pull_,
        temperature_;  ///< temperature_: where any conducts
};

SPAM_COMPILED(extern template class OwnRanges);

/// A fluid of such particles and nothing else.
template <int Dim>
class VariableRangeModel final : public ParticleModel<Dim> {
  public:
    VariableRangeModel(Particles<Dim> particles, const Fluid& fluid,
                       const VariableRangeScheme& scheme, const Box<Dim>& box = {})
        : ParticleModel<Dim>(std::move(particles), box),
          law(this->template add_term<OwnRanges<Dim>>(fluid, scheme)) {}

    const Fluid& fluid() const { return law.fluid(); }
    const VariableRangeScheme& scheme() const { return law.scheme(); }
    /// As OwnRanges::ranges(), start(), solve_densities().
    std::vector<double> ranges(std::span<const double> y) const { return law.ranges(y); }
    std::vector<double> state(const Points<Dim>& position, const Points<Dim>& velocity,
                              double T = 0.0) {
        return law.start(position, velocity, T);
    }
    std::vector<double> solve_densities(const Points<Dim>& position) const {
        return law.solve_densities(position);
    }

    OwnRanges<Dim>& law;
};

}  // namespace spam

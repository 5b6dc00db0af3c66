// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/general_weight.hpp>
#include <spam/material/fluid.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>

namespace spam {

template <int Dim>
struct RangeSweeps;
template <int Dim>
class PackedParticles;

/// How a fluid with ranges of its own is summed.
struct VariableRangeScheme {
    double range = 3.0;  ///< eta: h = eta (m/rho)^(1/D), the range where mass per volume is one
    Kernel kernel = Kernel::lucy;
    /// Change of the ranges left out of the forces (Omega = 1), as older codes do, for comparison: p, L
    /// and E stay exact, but e no longer is the work done on the density.
    bool without_gradients = false;

    std::string describe() const;
};

/// A fluid without friction whose particles have ranges that follow their densities
/// (physics/variable_range.hpp): y = (x, v, rho, e). The density is part of y, summed at the start and
/// then integrated, so that ranges are a function of y and no equation is solved in the rates. Keeps m, p
/// and sum m (e + v^2/2) exactly, in open space L as well.
template <int Dim>
class VariableRangeModel final : public ParticleModel<Dim> {
  public:
    /// Throws InputError where eta is so small that a particle would be its own only neighbour, and for a
    /// law with friction or conduction.
    VariableRangeModel(Particles<Dim> particles, const Fluid& fluid,
                       const VariableRangeScheme& scheme, const Box<Dim>& box = {});
    ~VariableRangeModel() override;

    std::size_t pairs() const override;
    /// The largest range of the latest rates().
    double reach() const override { return reach_; }
    void remember(Archive& archive) override;

    const Fluid& fluid() const { return fluid_; }
    const VariableRangeScheme& scheme() const { return scheme_; }
    /// h of all particles.
    std::vector<double> ranges(std::span<const double> y) const;

    /// y at `position` (Dim x N) with these velocities: densities and ranges that belong to each other, by
    /// Newton's method; energies as FluidModel::state(). Throws InputError where a range would have to
    /// reach half of a periodic length.
    std::vector<double> state(const Points<Dim>& position, const Points<Dim>& velocity,
                              double T = 0.0);
    /// N densities, each summed with its particle's own range, of particles at `position`.
    std::vector<double> solve_densities(const Points<Dim>& position) const;

  private:
    /// A range that has grown to half of a periodic length ends the run: failure() says so.
    void pair_rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double pair_energy(std::span<const double> y) const override;
    Promises pair_promises() const override;
    std::string pair_description() const override;

    double range_of(std::size_t i, double rho) const;
    double most_range() const;
    bool find_ranges(std::span<const double> y, std::span<double> y_dot);
    void make_room();
    template <class Fill>
    void fill(const Fill& fill);

    Fluid fluid_;
    VariableRangeScheme scheme_;
    GeneralWeight<Dim> unit_;
    std::unique_ptr<const RangeSweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;  ///< null before the first rates()
    double packed_reach_ = 0.0, reach_ = 0.0;
    std::vector<double> range_, pressure_, pull_, rho_dot_;
};

extern template class VariableRangeModel<1>;
extern template class VariableRangeModel<2>;
extern template class VariableRangeModel<3>;

}  // namespace spam

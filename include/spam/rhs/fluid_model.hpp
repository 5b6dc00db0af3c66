// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/kernel/general_weight.hpp>
#include <spam/material/fluid.hpp>
#include <spam/rhs/particle_model.hpp>

#include <memory>

namespace spam {

template <int Dim>
struct FluidSweeps;
template <int Dim>
class PackedParticles;
enum class ListUse;
struct PackedFields;

/// How a fluid is summed.
struct FluidScheme {
    Density density = Density::summed;  ///< or continuity
    Kernel kernel = Kernel::lucy;
    double range = 3.0;
    /// Of pairs, in gradients of velocity and temperature; without either it means nothing.
    MeanDensityKind mean_density = MeanDensityKind::arithmetic;

    /// "density summed, lucy weight of range 3"
    std::string describe(bool has_gradients) const;
};

/// A fluid of smooth particles, [HH01], [HH07] 4: y = (x, v, [rho], e),
///     v_dot_i = -sum_j m_j (P_i/rho_i^2 + P_j/rho_j^2) . grad_i w_ij
///     e_dot_i = 1/2 sum_j m_j (P_i/rho_i^2 + P_j/rho_j^2) : v_ij grad_i w_ij
///                 - sum_j m_j (Q_i/rho_i^2 + Q_j/rho_j^2) . grad_i w_ij
/// with P = p(rho, e) 1 - (viscous stress of grad v) and Q = -kappa grad T. Keeps m, p and
/// sum m (e + v^2/2) whatever the law; L too without viscosity, in open space.
template <int Dim>
class FluidModel final : public ParticleModel<Dim> {
  public:
    /// Throws InputError for a range that does not reach a neighbour, a periodic box not wider than
    /// twice the range, density by the chain rule, conduction in a law without temperature, negative
    /// coefficients (eta, bulk viscosity, kappa).
    FluidModel(Particles<Dim> particles, const Fluid& fluid, const FluidScheme& scheme,
               const Box<Dim>& box = {});
    ~FluidModel() override;

    double neighbour_forces(std::span<const double> y) const override;
    std::size_t pairs() const override;
    double reach() const override { return scheme_.range; }
    void remember(Archive& archive) override;
    std::size_t list_builds() const;

    const Fluid& fluid() const { return fluid_; }
    const FluidScheme& scheme() const { return scheme_; }
    /// N each; NaN outside the law. Precondition of temperature(): fluid().state.thermal.
    std::vector<double> pressure(std::span<const double> y) const;
    std::vector<double> temperature(std::span<const double> y) const;

    /// y at `position` (Dim x N) with these velocities, densities summed there where y carries them, and
    /// the energy of temperature T (thermal law) or the cold energy (T is then not read), else none.
    /// Scales of the layout are set for the tolerances.
    std::vector<double> state(const Points<Dim>& position, const Points<Dim>& velocity,
                              double T = 0.0);

  private:
    /// A particle whose density or energy is outside the law is named in failure().
    void pair_rates(double t, std::span<const double> y, std::span<double> y_dot) override;
    double pair_energy(std::span<const double> y) const override;
    std::vector<double> pair_density(std::span<const double> y) const override;
    Promises pair_promises() const override;
    std::string pair_description() const override;
    double pair_damping() const override { return damping_; }

    bool meaningful(std::span<const double> e, std::span<double> y_dot);
    void fill_records();
    void close(std::size_t first_slot, const std::uint32_t* particle, std::size_t count,
               const Mat<Dim>* grad_v, const Vec<Dim>* grad_T) const;
    std::vector<double> summed_density(const Points<Dim>& x) const;
    double estimate_damping() const;
    std::size_t stride() const;
    PackedFields fields(std::span<const double> y) const;
    std::unique_ptr<PackedParticles<Dim>> packed_with(ListUse use) const;

    Fluid fluid_;
    FluidScheme scheme_;
    GeneralWeight<Dim> weight_;
    std::unique_ptr<const FluidSweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
    double damping_ = 0.0;
    std::vector<double> density_, pressure_, temperature_;
};

extern template class FluidModel<1>;
extern template class FluidModel<2>;
extern template class FluidModel<3>;

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/symmetric_eigen.hpp>
#include <spam/kernel/general_weight.hpp>
#include <spam/material/fluid.hpp>
#include <spam/rhs/particle_model.hpp>

#include <limits>
#include <memory>

namespace spam {

template <int Dim>
struct Sweeps;
template <int Dim>
class PackedParticles;

namespace field_kind {
/// G of physics/ellipse.hpp: its eigenvalues are 1 by the squares of the half axes.
inline constexpr FieldKind shape{"shape", Rank::symmetric, Role::integrated, "1/l^2",
                                 6,       Quantity::tensor};
}  // namespace field_kind

/// How a fluid of ellipses is summed.
struct EllipseScheme {
    double range = 3.0;  ///< half axis of all particles at the start
    Kernel kernel = Kernel::w4;
    /// Above 0: the axis along the gradient of the density begins shorter, by 1/(1 + this |grad rho| range/rho).
    double gradient_share = 0.0;
    /// Longest by shortest axis, above 1: what is drawn out further is given this aspect after a step, with the
    /// volume it has. Its energy stays, so that none is made.
    double largest_aspect = std::numeric_limits<double>::infinity();
};

/// A fluid without friction whose particles are ellipses that are drawn out like the gas around them
/// (physics/ellipse.hpp): y = (x, v, e, G), the density summed. Keeps m and p exactly, L and E = sum m (e + v^2/2)
/// to integrator error, whatever the law. The density of a lattice does not change where it is deformed by the same F
/// everywhere.
template <int Dim>
class Ellipses final : public Term<Dim> {
  public:
    using typename Term<Dim>::Now;
    using typename Term<Dim>::Ask;
    using typename Term<Dim>::Answer;

    /// Throws InputError for a law with friction or conduction or whose energy is a function of the density (nothing
    /// could pay for a change of aspect), a range as SmoothParticles does, a negative share of the gradient, an aspect
    /// that is not above 1, and a periodic box, where an ellipse may become wider than the box.
    Ellipses(const Selection<Dim>& among, const Fluid& fluid, const EllipseScheme& scheme);
    ~Ellipses() override;

    /// Ends where a particle has neighbours on one line (in one plane) only, or G has lost its meaning.
    std::string rates(const Now& now) override;
    Answer answer(Ask what, std::span<const double> y) const override;
    bool settle(double t, const State<Dim>& state) override;

    /// y at `position` (Dim x N) with these velocities; energies as FluidModel::state().
    std::vector<double> start(const Points<Dim>& position, const Points<Dim>& velocity, double T);
    /// Longest by shortest axis of the most drawn out particle.
    double largest_aspect(std::span<const double> y) const;

  private:
    SymmetricEigen<Dim> axes(const double* shape, std::size_t i) const;
    std::string follow(PackedParticles<Dim>& packed, const ConstState<Dim>& state) const;
    std::string close_sums(const Now& now);
    std::vector<double> summed_density(std::span<const double> y) const;
    void shorten_along_gradient(std::span<double> y, const std::vector<double>& rho) const;

    Fluid fluid_;
    EllipseScheme scheme_;
    GeneralWeight<Dim> unit_;
    std::unique_ptr<const Sweeps<Dim>> sweeps_;
    std::unique_ptr<PackedParticles<Dim>> packed_;
};

SPAM_COMPILED(extern template class Ellipses);

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/rhs/smooth_particles.hpp>

#include <complex>
#include <vector>

namespace spam {

/// One solution exp(rate t + i k . r) of the linearised equations.
template <int Dim>
struct LatticeMode {
    std::complex<double> rate;  ///< real part: growth of amplitudes, imaginary part: frequency
    Eigen::Matrix<std::complex<double>, Dim, 1> velocity;  ///< part of an eigenvector of length one
};

/// Distance at which a disturbance of one particle changes the rates of another: the range, or twice
/// the range where density is summed or follows the transport velocity.
double coupling_reach(const Scheme& scheme);

/// Small disturbances of a periodic Bravais lattice at rest under uniform stress, [HHM04] IV. With
/// z_j = (x, v, [rho], sigma) of particle j, the equations linearised at rest are z_dot_i =
/// sum_j J_ij z_j. Every particle sees the same surroundings, so that the response of all particles
/// to a disturbance of one of them tells everything, and waves z_j = z exp(i k . r_j) obey
///     z_dot = J(k) z,    J(k) = sum_j J_j0 exp(-i k . (r_j - r_0))
/// for any k: a small sample knows the modes of all larger ones. The energy e is left out: no other
/// rate depends on it. J_j0 comes from rates at +-step (Richardson's extrapolation of two steps).
template <int Dim>
class LatticeModes {
  public:
    /// `y`: a state of `model` at rest, with uniform stress and density, on a Bravais lattice. The
    /// box must be periodic and wider than twice the coupling_reach().
    /// `step` in units of the spacing (positions), of the density, and of one. Throws InputError
    /// for a state without these properties, and for schemes without derivatives at rest (balanced
    /// torques).
    LatticeModes(SmoothParticleModel<Dim>& model, std::span<const double> y, double step = 1e-5);

    /// J(k), components in the order x, v, [rho], sigma.
    Eigen::MatrixXcd jacobian(const Point<Dim>& k) const;

    /// All modes, fastest growing first.
    std::vector<LatticeMode<Dim>> modes(const Point<Dim>& k) const;

    /// Largest real part of a rate: amplitudes grow like exp(rate t), kinetic energy twice as fast.
    double growth_rate(const Point<Dim>& k) const;

    /// The Dim highest frequencies, descending; zero where a branch grows instead.
    std::vector<double> frequencies(const Point<Dim>& k) const;

    /// Frequency of the oscillation whose velocity is along `direction` (or nearest to it).
    double frequency(const Point<Dim>& k, const Point<Dim>& direction) const;

    /// M(k) of v_ddot = M v for a disturbance that begins with velocities alone: the velocity part
    /// of J^2, because accelerations do not depend on velocities.
    Eigen::MatrixXcd acceleration_rate(const Point<Dim>& k) const;

    /// Right-hand sides that went into it.
    std::size_t rhs_evaluations() const { return rhs_evaluations_; }

  private:
    std::vector<std::size_t> components_;  ///< of z of particle 0, as entries of y
    std::vector<Point<Dim>> separation_;   ///< r_j - r_0, of particles that respond
    std::vector<Eigen::MatrixXd> block_;   ///< J_j0 of these
    std::size_t rhs_evaluations_ = 0;
};

SPAM_COMPILED(extern template class LatticeModes);

}  // namespace spam

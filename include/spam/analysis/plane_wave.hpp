// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/analysis/lattice_modes.hpp>
#include <spam/analysis/periodic_solid.hpp>
#include <spam/material/elastic_solid.hpp>

#include <string_view>

namespace spam {

enum class Polarization { transverse, longitudinal };
std::string_view to_string(Polarization);

/// A standing wave of linear elasticity with its wave vector along y, [HHM04] V:
///     u(y, t) = A sin(k y) cos(omega t), along x (transverse) or along y (longitudinal),
///     omega = c k,  c_T = sqrt(eta/rho),  c_L = sqrt((lambda + 2 eta)/rho).
struct PlaneWave {
    Polarization polarization;
    double amplitude;  ///< A, a length
    double k;
    double density;  ///< without the wave
    ElasticSolid solid;

    Point<2> direction() const;
    double frequency() const;  ///< omega of linear elasticity

    /// Adds the wave at t = 0, at rest, to a lattice at rest: displacements, the stresses that belong
    /// to them, density (where y carries it: longitudinal waves) and elastic energy.
    void add_to(const State<2>& state) const;

    /// Coefficient of sin(k y) in a field given at the reference positions, along direction().
    double coefficient(const Points<2>& reference, const Points<2>& field) const;

    /// Angular momentum of a side x side block moving with the flow, about its centre, for the
    /// frequency given, at (y, t): rho (side^4/12) omega k A cos(k y) sin(omega t); transverse.
    double block_angular_momentum(double side, double omega, double y, double t) const;
    /// Its rate at t = 0: (side^4/12) (d^2 sigma_xy/dx^2 - d^2 sigma_xy/dy^2) = (side^4/12) eta k^3 A
    /// cos(k y).
    double block_torque(double side, double y) const;
};

/// A standing wave as long as the lattice is high, and what is known of it beforehand.
struct StandingWave {
    PlaneWave wave;
    PeriodicSolid solid;                           ///< its y0 holds the wave
    std::shared_ptr<const LatticeModes<2>> modes;  ///< of the lattice without it, torques left free

    double wavelength() const { return solid.model->box().length(1); }
    double omega_lattice() const { return modes->frequency({0.0, wave.k}, wave.direction()); }
};

/// In cells x cells particles of the triangular lattice of springs (m = kappa = spacing = 1), free of
/// other stress. Throws InputError as triangular_solid() and LatticeModes do.
StandingWave standing_wave(Polarization polarization, int cells, double amplitude,
                           const Scheme& scheme);

}  // namespace spam

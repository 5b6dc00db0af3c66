// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace shock_tube {

/// Density, velocity and pressure of a gas.
struct GasState {
    double rho, u, P;

    double sound_speed(double gamma) const;
    double energy(double gamma) const;  ///< by mass; 0 in a vacuum
};

/// Two states of a perfect gas beside each other at x = 0, t = 0, and what becomes of them: exact (E. F. Toro,
/// Riemann Solvers and Numerical Methods for Fluid Dynamics, ch. 4), with the vacuum between gases that part
/// faster than they can follow. Precondition: both pressures are positive.
class RiemannProblem {
  public:
    RiemannProblem(const GasState& left, const GasState& right, double gamma);

    /// At x/t; any where t = 0. In a vacuum all is 0.
    GasState at(double x, double t) const;

    /// Whether the gases part: there is then no contact, and what follows is that of the vacuum.
    bool vacuum() const { return vacuum_; }
    double pressure() const { return P_; }  ///< between the waves
    double velocity() const { return u_; }
    double density(bool right) const;  ///< beside the contact
    bool shock(bool right) const { return P_ > (right ? right_ : left_).P; }  ///< or a fan
    /// Of the end of a wave on the side of the contact: of a shock, or of a fan's tail.
    double inner_speed(bool right) const;

  private:
    GasState beyond_wave(const GasState& outside, double sign, double speed) const;
    double shock_speed(const GasState& outside, double sign) const;

    GasState left_, right_;
    double gamma_, P_ = 0.0, u_ = 0.0;
    bool vacuum_;
};

}  // namespace shock_tube

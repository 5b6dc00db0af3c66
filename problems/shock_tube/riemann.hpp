// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace shock_tube {

/// Density, velocity and pressure of a gas.
struct GasState {
    double rho, u, P;
};

/// Two states of a perfect gas beside each other at x = 0, t = 0, and what becomes of them: exact (E. F. Toro,
/// Riemann Solvers and Numerical Methods for Fluid Dynamics, ch. 4). Precondition: no vacuum is left.
class RiemannProblem {
  public:
    RiemannProblem(const GasState& left, const GasState& right, double gamma);

    /// At x/t; any where t = 0.
    GasState at(double x, double t) const;

    double pressure() const { return P_; }  ///< between the waves
    double velocity() const { return u_; }
    double density(bool right) const;  ///< beside the contact

  private:
    GasState beyond_wave(const GasState& outside, double sign, double speed) const;

    GasState left_, right_;
    double gamma_, P_, u_;
};

}  // namespace shock_tube

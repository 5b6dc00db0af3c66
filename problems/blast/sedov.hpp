// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace blast {

/// A strong explosion: energy E is set free at a point (dim = 3), on a line (2) or on a plane (1; E by their
/// unit) of a cold perfect gas at rest, of density rho_0. All is a function of r/R(t), exact (L. I. Sedov;
/// Landau and Lifshitz, Fluid Mechanics, par. 106):
///     R = xi_0 (E t^2/rho_0)^(1/(dim + 2)).
/// With delta = 2/(dim + 2), v = delta (r/t) V, c^2 = (delta r/t)^2 Z, rho = rho_0 G and x = ln(r/R):
///     the energy inside of each r/R is constant    Z = gamma (gamma - 1) (1 - V) V^2/(2 (gamma V - 1))
///     the entropy of each particle is              Z'/Z - (gamma - 1) G'/G = -2 (1/delta - V)/(1 - V)
///     the mass as well                             (1 - V) G'/G = V' + dim V
/// from the strong shock, V = 2/(gamma + 1), G = (gamma + 1)/(gamma - 1), inwards to V = 1/gamma; xi_0 from the
/// integral of the energy.
class Sedov {
  public:
    Sedov(double gamma, int dim);

    double xi_0() const { return xi_0_; }
    /// Radius of the shock, and when it has one.
    double radius(double t, double E, double rho_0) const;
    double time(double R, double E, double rho_0) const;

    /// At r/R <= 1, by what they are behind the shock: (gamma + 1)/(gamma - 1) rho_0, 2/(gamma + 1) of the
    /// shock's speed D, 2/(gamma + 1) rho_0 D^2.
    struct Profile {
        double density, velocity, pressure;
    };
    Profile at(double r_by_R) const;

  private:
    int dim_;
    double xi_0_;
    std::vector<Profile> table_;  ///< by x, from 0 inwards
};

}  // namespace blast

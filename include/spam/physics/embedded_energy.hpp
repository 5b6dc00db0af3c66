// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/material/equation_of_state.hpp>
#include <spam/physics/density_potential.hpp>

namespace spam {

/// K = w: what all potentials of the density itself have in common.
struct DensityItself {
    static constexpr const char* name = "density";
    static constexpr int density_derivatives = 0;
    static constexpr double parity = 1.0;
    template <int Dim, class T = double>
    using Field = T;  ///< rho

    template <int Dim, class T>
    static T weigh(const WeightAt<Dim, T>& at) {
        return at.value;
    }
    /// G grad_i w
    template <int Dim, class T>
    static Vec<Dim, T> pull(const T& G, const WeightAt<Dim, T>& at) {
        return (G * at.slope) * at.n;
    }
};

/// The energy of a cold fluid as a potential ("embedded atoms"), [HH07] 6:
///     Phi = sum_i m_i e(rho_i),   F_i = -sum_j m_i m_j (P_i/rho_i^2 + P_j/rho_j^2) grad_i w_ij:
/// smooth particles of the law P = rho^2 de/d rho move like molecules of this potential. It does not
/// resist shear: lattices of it melt ([HH07] 8), strings form.
template <ColdEquationOfState Law>
struct EmbeddedEnergy : DensityItself {
    Law law;

    EmbeddedEnergy() = default;
    EmbeddedEnergy(const Law& l) : law(l) {}

    template <int Dim>
    double energy(double mass, double rho) const {
        return mass * law.cold_energy(rho);
    }
    template <int Dim>
    double slope(double mass, double rho) const {
        return mass * law.pressure(rho, 0.0) / (rho * rho);
    }
};

}  // namespace spam

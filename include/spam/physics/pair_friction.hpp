// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/pass_constants.hpp>
#include <spam/physics/stress_force.hpp>

#include <utility>

/// Friction and conduction by differences of pairs, in place of gradients of gradients (velocity_gradient.hpp,
/// heat_flow.hpp). A gradient of smooth particles does not see neighbours that move against each other, and
/// lets them; pairs damp every such motion. By Taylor's series, with F = -w'/r and the moments
///     int F r_a r_b = delta_ab,   int F r_a r_b r_c r_d/r^2 = (dd + dd + dd)_abcd/(D + 2)
/// of any weight function (integration by parts),
///     sum_j V_j F (v_j - v_i)               = (1/2) lap v
///     sum_j V_j F r (r . (v_j - v_i))/r^2   = (lap v + 2 grad div v)/(2 (D + 2)),
/// so that Newton's eta lap v + (lambda + eta) grad div v is the first times a = eta - lambda and the second
/// times b = (D + 2)(lambda + eta); heat diffuses as the first times 2 kappa. Coefficients of pairs must not
/// be negative, or some motion would grow: -eta <= lambda <= eta. With lambda = eta forces are central.
///
/// Between particles of different fluids eta, 2 eta + lambda and kappa are harmonic means, 2 c_i c_j/(c_i + c_j):
/// those by which the flux in shear, along the motion and of heat through two layers in turn, of a jump (v_j - v_i)
/// across both, is one flux (Cleary and Monaghan 1999; tests/rhs/friction_of_fluids.cpp: means of a and b themselves
/// would let fluids of one eta slip where their lambda differ). With the means M of eta and L of 2 eta + lambda
/// a = 3 M - L and b = (D + 2)(L - M), neither negative, as M <= L <= 3 M. A fluid without friction has none with
/// others either. Pairs have one factor, so that m, p and E are kept as among equals.
namespace spam {

/// The factor of a pair between two materials; 0 where either has none.
template <class T>
SPAM_INLINE T pair_factor(const T& i, const T& j) {
    return T(2.0) * (i * j) / (i + j + T(1e-300));
}

/// f_ij = F (a (v_j - v_i) + b r_ji (r_ji . (v_j - v_i))/r^2)/(rho_i rho_j), a and b of all particles or of records.
template <int Dim>
struct PairFriction {
    double a = 0.0, b = 0.0;
    static PairFriction with(const PassConstants& c) {
        return {c.shear - c.second_viscosity, (Dim + 2) * (c.second_viscosity + c.shear)};
    }

    template <class T>
    using Sums = ForceSums<Dim, T>;

    template <class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const T F = pair.minus_slope * (i.inverse_rho * j.inverse_rho);
        const auto [a_ij, b_ij] = factors<T>(i, j);
        const T along = b_ij * dot(pair.r_ji, pair.v_ji) / (pair.r2 + T(1e-300));
        sums.add(j.m, F * (a_ij * pair.v_ji + along * pair.r_ji), pair.v_ji);
    }
    template <class T, class Record>
    SPAM_INLINE std::pair<T, T> factors(const Record& i, const Record& j) const {
        if constexpr (requires { i.shear; }) {
            const T shear = pair_factor(i.shear, j.shear),
                    longitudinal = pair_factor(i.longitudinal, j.longitudinal);
            return {positive_part(T(3.0) * shear - longitudinal),
                    T(Dim + 2.0) * positive_part(longitudinal - shear)};
        } else {
            return {T(a), T(b)};
        }
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        sums.store_more(to);
    }
};

/// e_dot_i = sum_j m_j 2 kappa F (T_j - T_i)/(rho_i rho_j).
struct PairConduction {
    double twice_kappa = 0.0;
    static PairConduction with(const PassConstants& c) { return {2.0 * c.conductivity}; }

    template <class T>
    struct Sums {
        T e_dot{};
    };
    template <int Dim, class T, class Record>
    void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) const {
        const T F = pair.minus_slope * (i.inverse_rho * j.inverse_rho);
        sums.e_dot += j.m * (factor<T>(i, j) * F * (j.temperature - i.temperature));
    }
    template <class T, class Record>
    SPAM_INLINE T factor(const Record& i, const Record& j) const {
        if constexpr (requires { i.conduction; })
            return pair_factor(i.conduction, j.conduction);
        else
            return T(twice_kappa);
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        to.add(to.out.e_dot, sums.e_dot);
    }
};

}  // namespace spam

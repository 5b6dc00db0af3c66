// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/tensor.hpp>
#include <spam/neighbors/pair.hpp>
#include <spam/physics/record.hpp>
#include <spam/physics/scheme.hpp>

namespace spam {

/// Force of j on i for unit masses, f_ij = (sigma_i/rho_i^2 + sigma_j/rho_j^2) . grad_i w_ij,
/// [HHM04] II; f_ij = -f_ji bit for bit. In general not along r_ij: hence the angular momentum's
/// drift.
template <int Dim, class T, class Record>
constexpr Vec<Dim, T> stress_force(const Pair<Dim, T>& pair, const Record& i, const Record& j) {
    return (i.A + j.A) * pair.grad_w;
}

/// Rates that follow from pair forces, whatever changed them on the way:
///     v_dot_i = sum_j m_j f_ij,    e_dot_i = -1/2 sum_j m_j f_ij . v_ij,
/// so that sum m (e + v^2/2) is constant for any antisymmetric f_ij.
///
/// Work::own. The work of a stress may also be given to the particle whose stress it is,
///     e_dot_i = -sum_j m_j (sigma_i/rho_i^2) . grad_i w_ij . v_ij.
/// Where i and j are exchanged in sum_i m_i v_i . v_dot_i, the half with sigma_j takes sigma_i, and v_i becomes
/// -v_j: the sum is that of m_i m_j (sigma_i/rho_i^2) . grad_i w_ij . v_ij over all i and j, so that this form
/// keeps sum m (e + v^2/2) as exactly. For a pressure it is e_dot_i = (P_i/rho_i^2) sum_j m_j v_ij . grad_i w_ij:
/// where the sum is rho_dot_i, the gas of each particle stays on its adiabat, de = (P/rho^2) drho, and where
/// P is proportional to e nothing takes from a particle energy that it does not have. With the mean
/// a cold particle that recedes from a hot one does work by the other's pressure and its e falls below zero.
/// Only the mean form is that of all texts ([HH01], [HH07]).
template <int Dim, class T>
struct ForceSums {
    Vec<Dim, T> v_dot;
    T power{};  ///< sum_j m_j f_ij . (v_j - v_i)

    constexpr void add(const T& m_j, const Vec<Dim, T>& f_ij, const Vec<Dim, T>& v_ji) {
        v_dot += m_j * f_ij;
        power += m_j * dot(f_ij, v_ji);
    }
    /// The same for a force of which i's own stress makes f_i: all of its power is i's, and none of the rest.
    constexpr void add_own(const T& m_j, const Vec<Dim, T>& f_ij, const Vec<Dim, T>& f_i,
                           const Vec<Dim, T>& v_ji) {
        v_dot += m_j * f_ij;
        power += (T(2.0) * m_j) * dot(f_i, v_ji);
    }
    constexpr T e_dot() const { return T(0.5) * power; }

    /// As the rates, or on top of what a pass or a sweep before has stored.
    template <class To>
    constexpr void store(const To& to) const {
        to.set(to.out.v_dot, v_dot);
        to.set(to.out.e_dot, e_dot());
    }
    template <class To>
    constexpr void store_more(const To& to) const {
        to.add(to.out.v_dot, v_dot);
        to.add(to.out.e_dot, e_dot());
    }
};

/// The stress force as it is.
template <int Dim, Work work = Work::mean>
struct StressForce {
    template <class T>
    using Sums = ForceSums<Dim, T>;

    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        if constexpr (work == Work::own)
            sums.add_own(j.m, stress_force(pair, i, j), i.A * pair.grad_w, pair.v_ji);
        else
            sums.add(j.m, stress_force(pair, i, j), pair.v_ji);
    }
};

}  // namespace spam

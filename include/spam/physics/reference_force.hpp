// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/physics/lagrangian_record.hpp>
#include <spam/physics/pass_constants.hpp>

namespace spam {

/// sum_j V_j (P_i K_i^t + P_j K_j^t) . grad_i W_ij, the force of the stresses for unit V_i; P less the
/// penalty's M/V (B of StressedRecord). It is minus the derivative of U = sum V energy(F): with
/// P = d energy/dF and F_i = sum_j V_j (x_j - x_i) (x) K_i grad_i W_ij, particle i enters F_i and, as
/// x_i, every F_j; grad_j W_ij = -grad_i W_ij gives both terms the same sign. U does not change when
/// the body is turned: the angular momentum is kept although the pair forces are not central.
template <int Dim>
struct ReferenceForce {
    static constexpr bool light = true;  // sweep.hpp

    double inverse_density = 1.0;  ///< 1/rho_0 = V_i/m_i
    static ReferenceForce with(const PassConstants& c) { return {c.inverse_density}; }

    template <class T>
    struct Sums {
        Vec<Dim, T> force;
    };
    template <class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        sums.force += j.volume * ((i.B + j.B) * pair.grad_w);
    }
    template <class T, class Record>
    Vec<Dim, T> result(const Record&, const Sums<T>& sums) const {
        return T(inverse_density) * sums.force;
    }
    /// On top of what the penalty has stored.
    template <class To, class T>
    static void store(const To& to, const Vec<Dim, T>& v_dot) {
        to.add(to.out.v_dot, v_dot);
    }
};

}  // namespace spam

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/neighbors/pair.hpp>

namespace spam {

/// rho_dot_i = sum_j m_j (v_i - v_j) . grad_i w_ij: the time derivative of the summed density as
/// long as particles move with v, [HHM04] II.
struct Continuity {
    template <class T>
    struct Sums {
        T rho_dot{};
    };
    template <int Dim, class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record&, const Record& j, Sums<T>& sums) {
        sums.rho_dot -= j.m * dot(pair.v_ji, pair.grad_w);
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        if (to.out.rho_dot != nullptr) to.set(to.out.rho_dot, sums.rho_dot);
    }
};

/// The chain rule for particles that move with u: rho_dot_i = sum_j m_j (u_i - u_j) . grad_i w_ij,
/// [HHM04] VI.
struct ChainRuleContinuity {
    template <class T>
    struct Sums {
        T rho_dot{};
    };
    template <int Dim, class T, class Record>
    static void add(const Pair<Dim, T>& pair, const Record& i, const Record& j, Sums<T>& sums) {
        sums.rho_dot -= j.m * dot(j.u - i.u, pair.grad_w);
    }
    template <class To, class T>
    static void store(const To& to, const Sums<T>& sums) {
        if (to.out.rho_dot != nullptr) to.set(to.out.rho_dot, sums.rho_dot);
    }
};

}  // namespace spam
